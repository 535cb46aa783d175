#include "pdr/core/gyro_error_filter.hpp"

#include <algorithm>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {
/// Heading known nowhere: uniform over the circle.
constexpr double kUnknownHeading = kPi * kPi / 3.0;
/// Time over which a movement stays alike, s.
constexpr double kMovementTime = 1.0;
}  // namespace

GyroErrorFilter::GyroErrorFilter(const GyroErrorConfig& config) : config_(config) {
  const double sigma = config.initial_bias_sigma_radps;
  covariance_.diagonal() << kUnknownHeading, sigma * sigma, sigma * sigma, sigma * sigma;
}

void GyroErrorFilter::predict(double dt_s, const Eigen::Vector3d& up_in_body, double turned_rad) {
  // heading error' = heading error - up . bias error dt
  Eigen::Matrix4d transition = Eigen::Matrix4d::Identity();
  transition.block<1, 3>(0, 1) = -dt_s * up_in_body.transpose();
  covariance_ = transition * covariance_ * transition.transpose();
  // A movement goes on for a while, and so does what its scale error adds.
  const double drift = config_.scale_error * turned_rad / dt_s;
  const double walk = config_.bias_walk_radps_sqrt_s;
  covariance_(0, 0) += (config_.rate_noise_rad_sqrt_s * config_.rate_noise_rad_sqrt_s +
                        2.0 * kMovementTime * drift * drift) *
                       dt_s;
  covariance_.diagonal().tail<3>().array() += walk * walk * dt_s;
  add_heading_variance(0.0);
}

void GyroErrorFilter::add_heading_variance(double variance_rad2) {
  const double grown = covariance_(0, 0) + variance_rad2;
  if (grown > kUnknownHeading) {
    set_heading_variance(kUnknownHeading);
  } else {
    covariance_(0, 0) = grown;
  }
}

double GyroErrorFilter::correct_heading(double innovation_rad, double variance_rad2) {
  return update(Vector4::UnitX(), innovation_rad, variance_rad2);
}

void GyroErrorFilter::set_heading_variance(double variance_rad2) {
  covariance_.row(0).setZero();
  covariance_.col(0).setZero();
  covariance_(0, 0) = variance_rad2;
}

double GyroErrorFilter::correct_at_rest(const Eigen::Vector3d& mean_rate_radps) {
  double turn = 0.0;
  const double variance = config_.rest_sigma_radps * config_.rest_sigma_radps;
  for (int axis = 0; axis < 3; ++axis) {
    Vector4 row = Vector4::Zero();
    row[axis + 1] = 1.0;
    turn += update(row, mean_rate_radps[axis] - bias_[axis], variance);
  }
  return turn;
}

double GyroErrorFilter::correct_from_drift(const Eigen::Vector2d& drift_radps,
                                           const Eigen::Matrix<double, 2, 3>& level_rows,
                                           double dt_s) {
  double turn = 0.0;
  const double variance = config_.drift_sigma_radps * config_.drift_sigma_radps / dt_s;
  const Eigen::Vector3d bias_before = bias_;
  for (int axis = 0; axis < 2; ++axis) {
    Vector4 row = Vector4::Zero();
    row.tail<3>() = -level_rows.row(axis).transpose();
    // The first row's update already explains part of the second's drift.
    const double explained = -level_rows.row(axis).dot(bias_ - bias_before);
    turn += update(row, drift_radps[axis] - explained, variance);
  }
  return turn;
}

double GyroErrorFilter::update(const Vector4& row, double innovation, double variance) {
  const Vector4 projected = covariance_ * row;
  const double innovation_variance = row.dot(projected) + variance;
  const Vector4 gain = projected / innovation_variance;
  covariance_ -= gain * projected.transpose();
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
  const double limit = config_.largest_bias_radps;
  bias_ = (bias_ + gain.tail<3>() * innovation).cwiseMax(-limit).cwiseMin(limit);
  return gain[0] * innovation;
}

}  // namespace vpdr::pdr
