#include "pdr/core/attitude/attitude_error_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "core/square.hpp"
#include "pdr/core/attitude/uncalibrated.hpp"
#include "pdr/core/attitude/unknown_heading.hpp"

namespace vpdr::pdr {

namespace {

/// Time over which a movement, and with it what its cross-axis error adds, goes on, s.
constexpr double kMovementTime = 1.0;
/// Scale errors beyond this are no gyroscope's.
constexpr double kLargestScale = 0.1;

constexpr int kHeading = 2;
constexpr int kBias = 3;
constexpr int kScale = 6;
constexpr int kVelocity = 9;

}  // namespace

AttitudeErrorFilter::AttitudeErrorFilter(const AttitudeErrorConfig& config)
    : config_(config),
      base_(config.base),
      tilt_scale_(config.scale),
      heading_scale_(config.scale),
      timing_variance_s2_(square(config.timing_sigma_s)),
      bias_prior_(square(config.initial_bias_sigma_radps)),
      speed_variance_(square(config.usual_speed_mps)) {
  covariance_.diagonal().head<2>().setConstant(square(config.initial_tilt_sigma_rad));
  covariance_(kHeading, kHeading) = kUnknownHeading;
  doubt_gyroscope();
  covariance_.diagonal().segment<2>(kVelocity).setConstant(speed_variance_);
}

void AttitudeErrorFilter::predict(const Motion& motion) {
  state_.segment<2>(kVelocity) += motion.velocity_mps.head<2>();
  base_.add(motion.velocity_mps.z(), motion.duration_s);
  up_in_body_ = motion.rotation.row(2).transpose() / motion.duration_s;

  // velocity error' = attitude error x g up; attitude error' = -R (bias error - rate * scale error)
  const double g = kGravityMps2 * motion.duration_s;
  covariance_.row(kVelocity) += g * covariance_.row(1);
  covariance_.row(kVelocity + 1) -= g * covariance_.row(0);
  covariance_.col(kVelocity) += g * covariance_.col(1);
  covariance_.col(kVelocity + 1) -= g * covariance_.col(0);
  Eigen::Matrix<double, 6, 3> gain;
  gain << -motion.rotation.transpose(), motion.turn.transpose();
  // F P F' by the columns that change: P is symmetric.
  const Eigen::Matrix<double, kSize, 3> passed = covariance_.middleCols<6>(kBias).lazyProduct(gain);
  const Eigen::Matrix3d own = gain.transpose().lazyProduct(passed.middleRows<6>(kBias));
  covariance_.leftCols<3>() += passed;
  covariance_.topRows<3>() += passed.transpose();
  covariance_.topLeftCorner<3, 3>() += own;
  add_process_noise(motion);
}

void AttitudeErrorFilter::add_process_noise(const Motion& motion) {
  const double dt = motion.duration_s;
  const double cross_axis = config_.turning_error * motion.turned_rad / dt;
  const double unknown_rate = motion.has_gyro ? 0.0 : config_.no_gyro_rate_radps;
  const double attitude = square(config_.rate_noise_rad_sqrt_s) +
                          2.0 * kMovementTime * square(cross_axis) + square(unknown_rate);
  covariance_.diagonal().head<3>().array() += attitude * dt;
  covariance_.diagonal().segment<3>(kBias).array() += square(config_.bias_walk_radps_sqrt_s) * dt;
  covariance_.diagonal().segment<2>(kVelocity).array() +=
      square(config_.force_noise_mps2_sqrt_s) * dt;
  bound_heading_variance();
}

void AttitudeErrorFilter::correct_velocity(double duration_s, bool at_rest,
                                           const Eigen::Vector2d& expected_mps) {
  at_rest_ = at_rest;
  const Eigen::Vector2d measured = at_rest ? Eigen::Vector2d(0.0, 0.0) : expected_mps;
  const double seen = 0.5 * (state_.segment<2>(kVelocity) - measured).squaredNorm();
  speed_variance_ += std::min(1.0, duration_s / config_.speed_memory_s) * (seen - speed_variance_);
  const double speed_variance = at_rest
                                    ? square(config_.rest_speed_mps)
                                    : std::max(speed_variance_, square(config_.least_speed_mps));
  // A velocity that stays alike for a while is not new information each time.
  const double variance =
      speed_variance * std::max(1.0, 2.0 * config_.speed_correlation_s / duration_s);
  measure_velocity(measured, variance);
  if (at_rest) return;
  tilt_scale_.pass(duration_s);
  heading_scale_.pass(duration_s);
}

void AttitudeErrorFilter::correct_at_rest(const Eigen::Vector3d& mean_rate_radps) {
  for (int axis = 0; axis < 3; ++axis) {
    measure(kBias + axis, mean_rate_radps[axis] - bias_[axis] - state_[kBias + axis],
            square(config_.rest_sigma_radps));
  }
}

void AttitudeErrorFilter::correct_heading(double innovation_rad, double variance_rad2,
                                          const Eigen::Vector2d& tilt_row) {
  const Vector projected = covariance_.col(kHeading) + covariance_.leftCols<2>() * tilt_row;
  const double known = projected[kHeading] + tilt_row.dot(projected.head<2>());
  const double usual = config_.heading_surprise * (known + square(config_.heading_tolerance_rad));
  const double innovation = innovation_rad - state_[kHeading] - tilt_row.dot(state_.head<2>());
  const double doubt = std::max(1.0, square(innovation) / usual);
  const double total = known + doubt * variance_rad2;

  Vector gain = projected / total;
  gain.head<2>().setZero();
  gain.segment<2>(kVelocity).setZero();
  // A bias of the level axes would tilt the horizon from now on.
  gain.segment<3>(kBias) = (up_in_body_ * up_in_body_.dot(gain.segment<3>(kBias))).eval();
  state_ += gain * innovation;
  // A surprise that counts less is a surprise all the same.
  if (!at_rest_) {
    heading_scale_.add({gain[kHeading] * innovation, 0.0},
                       square(gain[kHeading]) * (known + variance_rad2));
  }
  // The general form for a gain that is not the optimal one.
  subtract(gain, projected, projected - total * gain, gain);
}

void AttitudeErrorFilter::align_heading(double angle_rad, double variance_rad2) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle_rad).toRotationMatrix();
  Matrix world = Matrix::Identity();
  world.topLeftCorner<2, 2>() = turn;
  world.block<2, 2>(kVelocity, kVelocity) = turn;
  state_.segment<2>(kVelocity) = (turn * state_.segment<2>(kVelocity)).eval();
  covariance_ = (world * covariance_ * world.transpose()).eval();
  set_heading_variance(variance_rad2);
}

void AttitudeErrorFilter::add_velocity_variance(double variance_m2ps2) {
  covariance_.diagonal().segment<2>(kVelocity).array() += variance_m2ps2;
}

void AttitudeErrorFilter::add_attitude_variance(double variance_rad2) {
  covariance_.diagonal().head<3>().array() += variance_rad2;
  bound_heading_variance();
}

void AttitudeErrorFilter::add_heading_variance(double variance_rad2) {
  covariance_(kHeading, kHeading) += variance_rad2;
  bound_heading_variance();
}

void AttitudeErrorFilter::level(double tilt_sigma_rad) {
  forget_tilt_and_velocity(std::min(std::max(tilt_sigma_rad, config_.least_tilt_sigma_rad),
                                    config_.initial_tilt_sigma_rad));
}

void AttitudeErrorFilter::restart(double sigma_rad) {
  forget_tilt_and_velocity(config_.initial_tilt_sigma_rad);
  add_attitude_variance(square(sigma_rad));
  // What was learned in motion says nothing of what happened in a gap.
  tilt_scale_ = CorrectionScale(config_.scale);
  heading_scale_ = tilt_scale_;
}

void AttitudeErrorFilter::doubt_gyroscope() {
  covariance_.middleRows<6>(kBias).setZero();
  covariance_.middleCols<6>(kBias).setZero();
  covariance_.diagonal().segment<3>(kBias).setConstant(bias_prior_);
  covariance_.diagonal().segment<3>(kScale).setConstant(square(config_.initial_scale_sigma));
}

void AttitudeErrorFilter::forget_tilt_and_velocity(double tilt_sigma_rad) {
  for (const int index : {0, 1, kVelocity, kVelocity + 1}) {
    covariance_.row(index).setZero();
    covariance_.col(index).setZero();
  }
  covariance_.diagonal().head<2>().setConstant(square(tilt_sigma_rad));
  speed_variance_ = square(config_.usual_speed_mps);
  covariance_.diagonal().segment<2>(kVelocity).setConstant(speed_variance_);
  state_.segment<2>(kVelocity).setZero();
}

Eigen::Vector3d AttitudeErrorFilter::take_turn() {
  Eigen::Vector3d turn = state_.head<3>();
  const double limit = config_.largest_bias_radps;
  bias_ = (bias_ + state_.segment<3>(kBias)).cwiseMax(-limit).cwiseMin(limit);
  scale_ = (scale_ + state_.segment<3>(kScale))
               .cwiseMax(1.0 - kLargestScale)
               .cwiseMin(1.0 + kLargestScale);
  state_.head<kVelocity>().setZero();
  if (bias_.squaredNorm() > bias_prior_) suspect_gyroscope();
  return turn;
}

/// A bias that was found to differ from none by more than the prior allows is a bad gyroscope's: it
/// is as if the prior had been wider from the start, and with it everything that came of it.
void AttitudeErrorFilter::suspect_gyroscope() {
  const double wide = square(kUncalibratedBias_radps);
  if (bias_prior_ >= wide) return;
  if (surprise_of(bias_, bias_prior_, bias_covariance()) < kSurprise) return;
  const Eigen::Matrix<double, kSize, 3> lever = covariance_.middleCols<3>(kBias) / bias_prior_;
  covariance_ += (wide - bias_prior_) * lever * lever.transpose();
  bias_prior_ = wide;
  bound_heading_variance();
}

Eigen::Matrix3d AttitudeErrorFilter::covariance_rad2(const Eigen::Vector3d& rate_radps) const {
  const double tilt = std::sqrt(tilt_scale_.factor());
  const Eigen::Vector3d scale(tilt, tilt, std::sqrt(heading_scale_.factor()));
  Eigen::Matrix3d out = scale.asDiagonal() * covariance_.topLeftCorner<3, 3>() * scale.asDiagonal();
  out.diagonal().head<2>().array() += base_.variance_rad2();
  out(kHeading, kHeading) += square(config_.heading_base_sigma_rad);
  out += timing_variance_s2_ * rate_radps * rate_radps.transpose();
  return out;
}

/// Both velocities, up to `variance` each: one update of rank two.
void AttitudeErrorFilter::measure_velocity(const Eigen::Vector2d& measured_mps, double variance) {
  const Vector x = covariance_.col(kVelocity);
  const Vector y = covariance_.col(kVelocity + 1);
  const double xx = x[kVelocity] + variance;
  const double yy = y[kVelocity + 1] + variance;
  const double xy = x[kVelocity + 1];
  const double scale = 1.0 / (xx * yy - xy * xy);
  const Vector gain_x = scale * (yy * x - xy * y);
  const Vector gain_y = scale * (xx * y - xy * x);
  const Eigen::Vector2d innovation = measured_mps - state_.segment<2>(kVelocity);
  const Vector step = gain_x * innovation.x() + gain_y * innovation.y();
  state_ += step;
  if (!at_rest_) {
    tilt_scale_.add(step.head<2>(),
                    gain_x.head<2>().dot(x.head<2>()) + gain_y.head<2>().dot(y.head<2>()));
  }
  subtract(gain_x, x, gain_y, y);
}

/// P -= a b' + c d', going over P once.
void AttitudeErrorFilter::subtract(const Vector& a, const Vector& b, const Vector& c,
                                   const Vector& d) {
  for (int j = 0; j < kSize; ++j) covariance_.col(j) -= a * b[j] + c * d[j];
}

void AttitudeErrorFilter::measure(int index, double innovation, double variance) {
  const Vector projected = covariance_.col(index);
  const Vector gain = projected / (projected[index] + variance);
  state_ += gain * innovation;
  covariance_ -= gain * projected.transpose();
}

void AttitudeErrorFilter::set_heading_variance(double variance_rad2) {
  covariance_.row(kHeading).setZero();
  covariance_.col(kHeading).setZero();
  covariance_(kHeading, kHeading) = variance_rad2;
}

void AttitudeErrorFilter::bound_heading_variance() {
  if (covariance_(kHeading, kHeading) > kUnknownHeading) set_heading_variance(kUnknownHeading);
}

}  // namespace vpdr::pdr
