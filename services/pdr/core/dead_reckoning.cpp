#include "pdr/core/dead_reckoning.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::pdr {

void DeadReckoning::add(const DeadReckonedStep& step) {
  if (!started_) {
    first_yaw_ = step.yaw_rad;
    started_ = true;
  }
  last_yaw_ = step.yaw_rad;
  const Eigen::Vector2d along(std::cos(step.yaw_rad), std::sin(step.yaw_rad));
  const Eigen::Vector2d across(-along.y(), along.x());
  position_ += step.length_m * along;
  path_length_ += step.length_m;

  // The heading error keeps its correlation with the past for a while and has today's variance.
  const double before = covariance_(2, 2);
  const double now = step.heading_sigma_rad * step.heading_sigma_rad;
  const double kept = before > 0.0 ? std::exp(-step.elapsed_s / config_.heading_correlation_s) *
                                         std::sqrt(now / before)
                                   : 0.0;
  covariance_.row(2) *= kept;
  covariance_.col(2) *= kept;
  covariance_(2, 2) = now;
  covariance_(3, 3) = step.scale_sigma * step.scale_sigma;

  Eigen::Matrix4d transition = Eigen::Matrix4d::Identity();
  transition.block<2, 1>(0, 2) = step.length_m * across;
  transition.block<2, 1>(0, 3) = step.length_m * along;
  covariance_ = transition * covariance_ * transition.transpose();
  const double across_noise = step.length_m * step.heading_noise_rad;
  covariance_.topLeftCorner<2, 2>() +=
      step.length_noise_m * step.length_noise_m * along * along.transpose() +
      across_noise * across_noise * across * across.transpose();
}

void DeadReckoning::turn(double angle_rad) {
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(angle_rad).toRotationMatrix();
  position_ = rotation * position_;
  Eigen::Matrix4d full = Eigen::Matrix4d::Identity();
  full.topLeftCorner<2, 2>() = rotation;
  covariance_ = full * covariance_ * full.transpose();
  first_yaw_ += angle_rad;
  last_yaw_ += angle_rad;
}

double DeadReckoning::height_variance_m2() const {
  const double drift = config_.height_drift * path_length_;
  return config_.height_sigma_m * config_.height_sigma_m + drift * drift;
}

Eigen::Vector2d DeadReckoning::heading_leverage_m() const {
  if (covariance_(2, 2) <= 0.0) return Eigen::Vector2d::Zero();
  return covariance_.block<2, 1>(0, 2) / std::sqrt(covariance_(2, 2));
}

double DeadReckoning::compass_turn_rad() const { return wrap_two_pi(first_yaw_ - last_yaw_); }

Eigen::Vector2d DeadReckoning::compass_position_m() const {
  return Eigen::Rotation2Dd(0.5 * kPi - first_yaw_) * position_;
}

double position_error_m(const Eigen::Vector2d& estimate_m, const Eigen::Vector2d& truth_m) {
  return (estimate_m - truth_m).norm();
}

}  // namespace vpdr::pdr
