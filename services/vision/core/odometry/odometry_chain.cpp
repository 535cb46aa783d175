#include "vision/core/odometry/odometry_chain.hpp"

#include <Eigen/LU>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::vision {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void OdometryChain::start(TimestampNs stamp_ns, const Eigen::Quaterniond& world_from_body,
                          double tilt_sigma_rad) {
  started_ = true;
  pose_ = {};
  pose_.stamp_ns = stamp_ns;
  pose_.world_from_body = world_from_body;
  covariance_.setZero();
  covariance_(3, 3) = covariance_(4, 4) = tilt_sigma_rad * tilt_sigma_rad;
  pose_.covariance = covariance_.topLeftCorner<6, 6>();
}

// A better known scale is less tied to the errors of the way behind: a Kalman update of the scale
// alone leaves the rest as it is and shrinks the ties with the variance.
void OdometryChain::share_scale(double sigma_share) {
  const double variance = sigma_share * sigma_share;
  double& kept = covariance_(6, 6);
  if (kept > variance && kept > 0.0) {
    const double ratio = variance / kept;
    covariance_.block<6, 1>(0, 6) *= ratio;
    covariance_.block<1, 6>(6, 0) *= ratio;
  }
  kept = variance;
}

void OdometryChain::advance(const MotionEstimate& motion, double scale_sigma_share) {
  share_scale(scale_sigma_share);
  const Matrix3d world_from_body = pose_.world_from_body.toRotationMatrix();
  const Vector3d moved = world_from_body * motion.translation_m;
  Matrix7d carry = Matrix7d::Identity();
  carry.block<3, 3>(0, 3) = -skew(moved);
  carry.block<3, 1>(0, 6) = moved;
  covariance_ = (carry * covariance_ * carry.transpose()).eval();
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = world_from_body;
  turn.bottomRightCorner<3, 3>() = world_from_body;
  covariance_.topLeftCorner<6, 6>() += turn * motion.covariance * turn.transpose();
  const double dt = to_seconds(motion.stamp_ns - pose_.stamp_ns);
  pose_.stamp_ns = motion.stamp_ns;
  pose_.position_m += moved;
  pose_.world_from_body = (pose_.world_from_body * motion.rotation).normalized();
  pose_.covariance = covariance_.topLeftCorner<6, 6>();
  if (!(dt > 0.0)) return;
  pose_.angular_velocity_radps = log_rotation(motion.rotation) / dt;
  pose_.speed_mps = motion.translation_m.norm() / dt;
}

// The vertical's errors last longer than a frame, so each frame's vertical weighs little.
void OdometryChain::level(const Vector3d& up_body, double sigma_rad, double dt_s) {
  const Vector3d up = pose_.world_from_body * up_body;
  const Vector3d off(up.y(), -up.x(), 0.0);  // rotation that would bring it to the zenith
  const double noise = sigma_rad * sigma_rad * std::max(1.0, config_.tilt_time_s / dt_s);
  Eigen::Matrix2d total = covariance_.block<2, 2>(3, 3);
  total.diagonal().array() += noise;
  const Eigen::Matrix2d gain = covariance_.block<2, 2>(3, 3) * total.inverse();
  const Eigen::Vector2d turn = gain * off.head<2>();
  pose_.world_from_body =
      (exp_rotation({turn.x(), turn.y(), 0.0}) * pose_.world_from_body).normalized();
  Matrix7d keep = Matrix7d::Identity();
  keep.block<2, 2>(3, 3) -= gain;
  covariance_ = (keep * covariance_ * keep.transpose()).eval();
  covariance_.block<2, 2>(3, 3) += noise * gain * gain.transpose();
  pose_.covariance = covariance_.topLeftCorner<6, 6>();
}

}  // namespace vpdr::vision
