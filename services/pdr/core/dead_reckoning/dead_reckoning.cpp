#include "pdr/core/dead_reckoning/dead_reckoning.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "core/square.hpp"
#include "pdr/core/attitude/unknown_heading.hpp"

namespace vpdr::pdr {

namespace {

/// A weaker horizontal field tells no heading, uT.
constexpr double kLeastNorth = 2.0;
/// Of a device that points forward, rad: alike for the walk, and never revised.
constexpr double kAlignedSigma = 0.05;
/// A heading less certain than this may be nearer to the next corridor, a quarter turn on, rad.
constexpr double kAmbiguous = 0.35;
/// A walking direction less certain than this tells no velocity, rad.
constexpr double kSureForward = 0.35;
/// Straight stretches that differ more from a corridor do not lie along it, rad.
constexpr double kUnlike = 0.3;
/// What the direction of the corridors may change from one stretch to the next, of its variance.
constexpr double kCorridorWander = 0.05;
/// Time over which a movement stays alike, s.
constexpr double kMovementTime = 1.0;

Eigen::Vector2d direction(double yaw_rad) { return {std::cos(yaw_rad), std::sin(yaw_rad)}; }

}  // namespace

DeadReckoningConfig worn_at(DeadReckoningConfig config, Carry carry) {
  if (carry == Carry::kPocket) config.forward_sigma_rad = config.pocket_sigma_rad;
  return config;
}

DeadReckoning::DeadReckoning(const DeadReckoningConfig& config, const FieldConfig& field,
                             double declination_rad)
    : config_(config),
      field_(field),
      declination_(declination_rad),
      suspected_iron_ut2_(square(field.iron_sigma_ut)) {
  p_(kForward, kForward) = square(config.forward_sigma_rad);
  p_.diagonal().segment<3>(kBias).setConstant(square(config.bias_sigma_radps));
  p_.diagonal().segment<2>(kNorth).setConstant(square(field.strength_ut));
  p_.diagonal().segment<3>(kIron).setConstant(square(field.iron_sigma_ut));
  p_.diagonal().segment<2>(kDisturbance).setConstant(square(field.disturbance_sigma_ut));
}

void DeadReckoning::add(const DeadReckonedStep& step) {
  if (!started_) {
    first_yaw_ = step.relative_yaw_rad;
    // Common to all steps and never observed here, so nothing else depends on it yet.
    p_(kScale, kScale) = square(step.scale_sigma);
    started_ = true;
  }
  last_yaw_ = step.relative_yaw_rad;
  const Eigen::Vector2d along = direction(step.relative_yaw_rad + x_[kLag] + x_[kForward]);
  const Eigen::Vector2d across(-along.y(), along.x());
  const double length = step.length_m * (1.0 + x_[kScale]);
  x_.segment<2>(kX) += length * along;
  path_length_ += length;
  since_field_m_ += std::abs(length);

  Matrix transition = Matrix::Identity();
  transition.block<2, 1>(kX, kLag) = length * across;
  transition.block<2, 1>(kX, kForward) = length * across;
  transition.block<2, 1>(kX, kScale) = step.length_m * along;
  p_ = (transition * p_ * transition.transpose()).eval();
  p_.block<2, 2>(kX, kX) += square(step.length_noise_m) * along * along.transpose() +
                            square(length * step.heading_noise_rad) * across * across.transpose();
}

void DeadReckoning::pass(const RelativeMotion& motion) {
  const double dt = motion.elapsed_s;
  if (dt <= 0.0) return;
  x_[kLag] -= motion.up_s.dot(x_.segment<3>(kBias));
  p_.row(kLag) -= (motion.up_s.transpose() * p_.middleRows<3>(kBias)).eval();
  p_.col(kLag) -= (p_.middleCols<3>(kBias) * motion.up_s).eval();
  // A movement goes on for a while, and so does what its scale error adds.
  const double turning = config_.turn_error * motion.turned_rad / dt;
  p_(kLag, kLag) +=
      (square(config_.rate_noise_rad_sqrt_s) + 2.0 * kMovementTime * square(turning)) * dt +
      motion.blind_rad2;
  p_.diagonal().segment<3>(kBias).array() += square(config_.bias_walk_radps_sqrt_s) * dt;
  limit_lag_variance();
  since_field_m_ += field_.standing_mps * dt;
  if (motion.rest_bias_radps) take_rest(*motion.rest_bias_radps);
  x_.segment<3>(kBias) -= motion.bias_change_radps;
}

void DeadReckoning::stray(double distance_m) {
  p_.diagonal().segment<2>(kX).array() += 0.5 * square(distance_m);
  since_field_m_ += distance_m;
}

void DeadReckoning::find_forward(double offset_rad, double variance_rad2) {
  forget_corridor();
  const double turn = wrap_pi(offset_rad - x_[kForward]);
  const Eigen::Matrix2d rotation = Eigen::Rotation2Dd(turn).toRotationMatrix();
  // The way that was walked with it lies across what the position makes of its error.
  const Eigen::Vector2d across = p_.block<2, 1>(kX, kForward) / p_(kForward, kForward);
  const Eigen::Vector2d way(across.y(), -across.x());
  x_.segment<2>(kX) += rotation * way - way;
  x_[kForward] = wrap_pi(offset_rad);
  revision_ += turn;
  turn_errors(rotation);
  const Vector lever = p_.col(kForward) / p_(kForward, kForward);
  p_ += (variance_rad2 - p_(kForward, kForward)) * lever * lever.transpose();
}

/// Where all of the way is turned its errors turn with it; otherwise those of the offset do.
void DeadReckoning::turn_errors(const Eigen::Matrix2d& rotation) {
  if (!was_carried_anew_) {
    p_.middleRows<2>(kX) = (rotation * p_.middleRows<2>(kX)).eval();
    p_.middleCols<2>(kX) = (p_.middleCols<2>(kX) * rotation.transpose()).eval();
    return;
  }
  const Eigen::Vector2d before = p_.block<2, 1>(kX, kForward) / p_(kForward, kForward);
  Matrix transition = Matrix::Identity();
  transition.block<2, 1>(kX, kForward) = rotation * before - before;
  p_ = (transition * p_ * transition.transpose()).eval();
}

void DeadReckoning::carried_anew(double forward_sigma_rad) {
  was_carried_anew_ = started_;
  forget_corridor();
  x_[kForward] = 0.0;
  forget(kForward);
  p_(kForward, kForward) = square(forward_sigma_rad);
}

void DeadReckoning::carried_on(double variance_rad2) {
  was_carried_anew_ = started_;
  p_(kForward, kForward) += variance_rad2;
}

void DeadReckoning::take_rest(const Eigen::Vector3d& bias_radps) {
  for (int axis = 0; axis < 3; ++axis) {
    const int index = kBias + axis;
    observe(Vector::Unit(index), bias_radps[axis] - x_[index], square(config_.rest_sigma_radps));
  }
}

/// One number whose errors are those of row x and white noise.
void DeadReckoning::observe(const Vector& row, double innovation, double variance) {
  const Vector projected = p_ * row;
  const double spread = row.dot(projected) + variance;
  const Vector gain = projected / spread;
  correct(gain * innovation);
  p_ -= spread * gain * gain.transpose();
}

/// Nothing is known of it, nor of what it has to do with the rest.
void DeadReckoning::forget(Index index) {
  p_.row(index).setZero();
  p_.col(index).setZero();
}

void DeadReckoning::take(const StraightStretch& stretch) {
  const double seen = stretch.direction_rad - world_from_odom_rad();
  if (!knows_corridor_) return find_corridor(seen, stretch.variance_rad2);
  if (!stretch.is_usual) return;
  const double residual = wrap_pi(4.0 * (x_[kCorridor] - seen)) / 4.0;
  // The corridor it was first seen in is not like the others.
  if (std::abs(residual) > kUnlike) return find_corridor(seen, stretch.variance_rad2);
  const Vector row = Vector::Unit(kLag) + Vector::Unit(kForward) - Vector::Unit(kCorridor);
  if (row.dot(p_ * row) > square(kAmbiguous)) return;
  observe(row, residual, stretch.variance_rad2);
  p_(kCorridor, kCorridor) += kCorridorWander * stretch.variance_rad2;
}

/// Its error is that of the walking direction it is seen with.
void DeadReckoning::find_corridor(double direction_rad, double variance_rad2) {
  knows_corridor_ = true;
  x_[kCorridor] = direction_rad;
  const Vector walking = p_.col(kLag) + p_.col(kForward);
  p_.row(kCorridor) = walking.transpose();
  p_.col(kCorridor) = walking;
  p_(kCorridor, kCorridor) = walking[kLag] + walking[kForward] + variance_rad2;
}

void DeadReckoning::forget_corridor() {
  knows_corridor_ = false;
  forget(kCorridor);
}

void DeadReckoning::correct(const Vector& correction) {
  const double before = offset_rad();
  x_ += correction;
  revision_ += wrap_pi(offset_rad() - before);
}

/// A heading known nowhere does not get more unknown.
void DeadReckoning::limit_lag_variance() {
  if (p_(kLag, kLag) <= kUnknownHeading) return;
  const double share = std::sqrt(kUnknownHeading / p_(kLag, kLag));
  p_.row(kLag) *= share;
  p_.col(kLag) *= share;
}

double DeadReckoning::world_from_odom_rad() const {
  if (!yaw_is_absolute_) return 0.0;
  return std::atan2(x_[kNorth], x_[kNorth + 1]) - declination_;
}

DeadReckoning::Vector DeadReckoning::yaw_row() const {
  Vector row = Vector::Unit(kLag);
  const Eigen::Vector2d north = x_.segment<2>(kNorth);
  if (yaw_is_absolute_) {
    row.segment<2>(kNorth) = Eigen::Vector2d(north.y(), -north.x()) /
                             std::max(north.squaredNorm(), kLeastNorth * kLeastNorth);
  }
  return row;
}

Eigen::Vector2d DeadReckoning::position_m() const {
  return Eigen::Rotation2Dd(world_from_odom_rad()) * x_.segment<2>(kX);
}

Eigen::Matrix3d DeadReckoning::covariance() const {
  const Vector yaw = yaw_row();
  Eigen::Matrix<double, 3, kSize> rows = Eigen::Matrix<double, 3, kSize>::Zero();
  rows.block<2, 2>(0, kX) = Eigen::Rotation2Dd(world_from_odom_rad()).toRotationMatrix();
  // What turns odom turns the whole walk about its start.
  const Eigen::Vector2d position = position_m();
  rows.block<2, 2>(0, kNorth) =
      Eigen::Vector2d(-position.y(), position.x()) * yaw.segment<2>(kNorth).transpose();
  rows.row(2) = yaw.transpose();
  Eigen::Matrix3d covariance = rows * p_ * rows.transpose();
  // Bounded together with what it has to do with the position: a covariance all the same.
  if (covariance(2, 2) > kUnknownHeading) {
    const double share = std::sqrt(kUnknownHeading / covariance(2, 2));
    covariance.row(2) *= share;
    covariance.col(2) *= share;
  }
  return covariance;
}

double DeadReckoning::walking_variance_rad2() const {
  const Vector row = yaw_row() + Vector::Unit(kForward);
  return std::min(row.dot(p_ * row), kUnknownHeading);
}

bool DeadReckoning::knows_forward() const { return p_(kForward, kForward) < square(kSureForward); }

double DeadReckoning::zero_variance_rad2() const {
  const double own = std::min(p_(kForward, kForward), square(kAlignedSigma));
  return std::max(walking_variance_rad2() - own, 0.0);
}

double DeadReckoning::height_variance_m2() const {
  return square(config_.height_sigma_m) + square(config_.height_drift * path_length_);
}

double DeadReckoning::compass_turn_rad() const { return wrap_two_pi(first_yaw_ - last_yaw_); }

Eigen::Vector2d DeadReckoning::compass_position_m() const {
  return Eigen::Rotation2Dd(0.5 * kPi - first_yaw_ - walking_offset_rad()) * position_m();
}

double position_error_m(const Eigen::Vector2d& estimate_m, const Eigen::Vector2d& truth_m) {
  return (estimate_m - truth_m).norm();
}

}  // namespace vpdr::pdr
