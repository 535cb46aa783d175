#pragma once
// The body's attitude at the instant of a frame, interpolated between pdr's estimates around it.
// The answer depends on the estimates only, not on when they arrive: a frame waits for the first
// estimate at or after its stamp. Not thread-safe; allocates nothing after construction.
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/estimates.hpp"

namespace vpdr::vision {

/// How far the body has turned to the left since the epoch began, by its gyroscope alone, so that
/// no magnetic field and no discovery of north turns it. Turns of one epoch may be compared.
struct GyroTurn {
  double rad = 0.0;
  std::uint32_t epoch = 0;
  Eigen::Quaterniond start_from_body = Eigen::Quaterniond::Identity();  ///< about all axes
};

/// What is known of the body at the instant of a frame.
struct AttitudePrior {
  Eigen::Quaterniond world_from_body = Eigen::Quaterniond::Identity();
  double inclination_sigma_rad = 0.03;  ///< of each tilt, mounting of the camera included
  std::optional<GyroTurn> turn;
};

/// Turn of the body between two instants (earlier from later), by its gyroscope; nothing unless
/// both belong to one epoch.
std::optional<Eigen::Quaterniond> turn_between(const std::optional<AttitudePrior>& earlier,
                                               const std::optional<AttitudePrior>& later);

struct AttitudeTrackConfig {
  double mounting_sigma_rad = 0.02;  ///< of the camera on the body, each tilt
  double max_gap_s = 0.1;            ///< estimates further apart are not interpolated
};

class AttitudeTrack {
 public:
  explicit AttitudeTrack(const AttitudeTrackConfig& config = {});

  /// Takes pdr's next estimate; those not later than the one before are left out.
  void add(const AttitudeEstimate& attitude);

  /// True once the attitude at `stamp_ns` is known, or can no longer become known.
  [[nodiscard]] bool is_due(TimestampNs stamp_ns) const;
  /// Attitude at a stamp that is due; nothing before the oldest estimate kept and inside a gap.
  [[nodiscard]] std::optional<AttitudePrior> at(TimestampNs stamp_ns) const;

  /// Stamp of the newest estimate.
  [[nodiscard]] std::optional<TimestampNs> newest_ns() const;

 private:
  struct Entry {
    TimestampNs stamp_ns = 0;
    Eigen::Quaterniond world_from_body = Eigen::Quaterniond::Identity();
    double inclination_sigma_rad = 0.0;
    double up_rate_radps = 0.0;
    Eigen::Vector3d rate_radps = Eigen::Vector3d::Zero();  ///< body axes
    GyroTurn turn;
  };
  [[nodiscard]] const Entry& entry(std::size_t age) const;

  AttitudeTrackConfig config_;
  std::vector<Entry> ring_;
  std::size_t count_ = 0;  ///< entries ever pushed
};

}  // namespace vpdr::vision
