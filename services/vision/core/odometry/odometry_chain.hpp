#pragma once
// From motions between frames to a pose in the world, with its covariance. World ENU, metres. The
// start is the origin and faces the yaw it is given; yaw and position drift from there, the tilt is
// held by the vertical. Not thread-safe; allocates nothing.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "core/estimates.hpp"

namespace vpdr::vision {

struct OdometryChainConfig {
  double tilt_time_s = 2.0;  ///< the vertical's say builds up over this time
};

class OdometryChain {
 public:
  explicit OdometryChain(const OdometryChainConfig& config = {}) : config_(config) {}

  /// Begins at the origin.
  void start(TimestampNs stamp_ns, const Eigen::Quaterniond& world_from_body,
             double tilt_sigma_rad);
  [[nodiscard]] bool started() const { return started_; }
  /// `motion.covariance` without the scale's part; `scale_sigma_share`: what all lengths have in
  /// common.
  void advance(const MotionEstimate& motion, double scale_sigma_share);
  /// `up_body`: the vertical, unit, body axes at the last motion's end; `dt_s` since the last.
  void level(const Eigen::Vector3d& up_body, double sigma_rad, double dt_s);

  /// The pose now; speed and turn rate of the last motion.
  [[nodiscard]] const PoseEstimate& pose() const { return pose_; }

 private:
  using Matrix7d = Eigen::Matrix<double, 7, 7>;  // position, rotation (world axes), log scale
  void share_scale(double sigma_share);

  OdometryChainConfig config_;
  bool started_ = false;
  PoseEstimate pose_;
  Matrix7d covariance_ = Matrix7d::Zero();
};

}  // namespace vpdr::vision
