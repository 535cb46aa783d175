#pragma once
// A path that somebody went, from a reference: poses in time, position interpolated linearly and
// attitude along the great circle (slerp). World ENU, metres. Thread-safe once made.
#include <Eigen/Geometry>
#include <vector>

#include "core/time.hpp"

namespace vpdr::simulation {

struct PathPose {
  TimestampNs stamp_ns = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond world_from_body = Eigen::Quaterniond::Identity();
};

class ReferencePath {
 public:
  /// Poses that are not finite or not later than the one before are left out. Throws
  /// ConfigurationFault where fewer than two remain.
  explicit ReferencePath(const std::vector<PathPose>& poses);

  [[nodiscard]] const std::vector<PathPose>& poses() const { return poses_; }
  [[nodiscard]] TimestampNs begin_ns() const { return poses_.front().stamp_ns; }
  [[nodiscard]] TimestampNs end_ns() const { return poses_.back().stamp_ns; }
  [[nodiscard]] double length_m() const;
  /// Pose of the body at an instant, clamped to the path's ends.
  [[nodiscard]] Eigen::Isometry3d at(TimestampNs stamp_ns) const;
  /// True where the reference has a pose within `gap_ns` before and after the instant: elsewhere
  /// the path is a guess.
  [[nodiscard]] bool is_known(TimestampNs stamp_ns, TimestampNs gap_ns) const;

 private:
  [[nodiscard]] std::vector<PathPose>::const_iterator after(TimestampNs stamp_ns) const;

  std::vector<PathPose> poses_;
};

/// Stamps at a rate between the path's ends, where the path is known: 0.1 s at most to the poses
/// before and after.
std::vector<TimestampNs> frames_along(const ReferencePath& path, double rate_hz);

}  // namespace vpdr::simulation
