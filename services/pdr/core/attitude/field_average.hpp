#pragma once
// Mean magnetic field over short blocks in a frame that the magnetometer does not move. A
// magnetometer sample is used with the first inertial sample that is later, turned back to its own
// time, so the order of arrival of equal stamps does not matter. Readings far from the block's
// median, such as those of a sensor that overflows, are left out; a block does not span a gap of
// the inertial samples. Microtesla, rad. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/samples.hpp"

namespace vpdr::pdr {

/// A field older than this when it is used has been turned too far for the last rate to undo.
inline constexpr double kOldestField_s = 0.1;

/// A block's mean.
struct MeanField {
  Eigen::Vector2d horizontal_ut = Eigen::Vector2d::Zero();  ///< odom axes
  double up_ut = 0.0;
  /// First two rows of odom-from-body, averaged: what a field fixed to the body adds to it.
  Eigen::Matrix<double, 2, 3> level_rows = Eigen::Matrix<double, 2, 3>::Zero();
};

class FieldAverage {
 public:
  /// A silence of the inertial samples longer than `gap_s` ends a block: its turn is not known.
  FieldAverage(double block_s, double gap_s) : block_s_(block_s), gap_s_(gap_s) {}

  void add(const MagSample& sample);
  /// The body's attitude and rate (body axes) at a stamp later than all before. A reading is older
  /// than its stamp by `delay_s`.
  void advance(TimestampNs stamp_ns, const Eigen::Quaterniond& odom_from_body,
               const Eigen::Vector3d& rate_radps, double delay_s = 0.0);
  /// The block that is full, once. None of one whose readings do not agree at all.
  std::optional<MeanField> take();
  /// Readings left out as unlike the others of their block.
  [[nodiscard]] std::uint64_t outliers() const { return outliers_; }

 private:
  /// A reading in odom axes, with the first two rows of odom-from-body.
  struct Entry {
    Eigen::Vector3d field_ut = Eigen::Vector3d::Zero();
    Eigen::Matrix<double, 2, 3> level_rows = Eigen::Matrix<double, 2, 3>::Zero();
  };
  /// Of a block; what a fast magnetometer sends beyond it is left out.
  static constexpr std::size_t kMost = 64;

  [[nodiscard]] Eigen::Vector3d median_ut() const;

  double block_s_;
  double gap_s_;
  std::array<MagSample, 16> pending_{};
  std::size_t pending_count_ = 0;
  std::array<Entry, kMost> entries_{};
  std::size_t count_ = 0;
  std::uint64_t outliers_ = 0;
  TimestampNs first_ns_ = 0;
  TimestampNs last_ns_ = 0;
};

}  // namespace vpdr::pdr
