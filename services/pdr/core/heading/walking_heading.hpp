#pragma once
// Heading of the device: the horizontal direction of its forward axis, averaged over a step.
// Each step sways the body to its own side; the mean over whole steps does not. Yaw is that of the
// frame the attitudes are in, counter-clockwise, rad. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>

#include "core/time.hpp"
#include "pdr/core/carry.hpp"

namespace vpdr::pdr {

struct HeadingConfig {
  double period_s = 0.05;  ///< s, between published headings; (0.005, 1)
  double window_s = 0.6;   ///< s, averaged for the published heading while not walking; (0.05, 4)
  /// rad, of the walking direction about the device's from step to step, worn on the trunk; (0, 1)
  double sway_sigma_rad = 0.03;
  /// rad, the same in hand, pocket or nobody knows where: what adds up like the 0.11 to 0.22 rad,
  /// alike for a second or two, that recorded phones turn about their owners' way; (0, 1)
  double loose_sigma_rad = 0.3;
  double turned_over_rad = 0.8;  ///< rad of tilt that make another way of carrying it; (0, 3)
  /// rad, how far a walker's direction may change while the device is moved; (0, 3)
  double carried_on_sigma_rad = 0.4;
};

/// The one of the two that holds there.
[[nodiscard]] double sway_sigma_rad(const HeadingConfig& config, Carry carry);

/// The forward axis seen from above; short where it points up or down.
[[nodiscard]] Eigen::Vector2d forward_heading(const Eigen::Quaterniond& frame_from_body);

class WalkingHeading {
 public:
  /// Horizontal direction (of length 1 at most) at a stamp later than all before.
  void add(TimestampNs stamp_ns, const Eigen::Vector2d& heading);
  /// Forgets the past: after a gap.
  void reset();

  struct Mean {
    double yaw_rad = 0.0;
    /// Length of the mean forward direction on the horizontal plane, 0 to 1: near 0 the forward
    /// axis points up or down, or turned all ways, and yaw means nothing.
    double clarity = 0.0;
    /// Direction error of so clear a mean: none at 1, any at 0.
    [[nodiscard]] double unclear_sigma_rad() const;
  };
  /// Mean over [from, to], cut to what is remembered (the last 6 s).
  [[nodiscard]] Mean mean(TimestampNs from_ns, TimestampNs to_ns) const;

 private:
  struct Entry {
    TimestampNs stamp_ns = 0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();  ///< integral of the direction up to the stamp
  };
  static constexpr std::size_t kCapacity = 512;
  static constexpr TimestampNs kSpacing = 12'000'000;

  [[nodiscard]] const Entry& at(std::size_t age) const {
    return entries_[(next_ + kCapacity - 1 - age) % kCapacity];
  }
  [[nodiscard]] Eigen::Vector2d sum_at(TimestampNs stamp_ns) const;

  std::array<Entry, kCapacity> entries_{};
  std::size_t count_ = 0;
  std::size_t next_ = 0;
  Entry newest_;  ///< running, not yet stored
  bool started_ = false;
};

}  // namespace vpdr::pdr
