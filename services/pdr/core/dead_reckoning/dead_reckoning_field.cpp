// What the magnetometer tells dead reckoning.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "core/square.hpp"
#include "pdr/core/attitude/uncalibrated.hpp"
#include "pdr/core/dead_reckoning/dead_reckoning.hpp"

namespace vpdr::pdr {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

/// A lag less certain than this is found anew from the field, rad.
constexpr double kLostSigma = 1.0;
constexpr double kFoundSigma = 0.5;
/// Contradiction that tells of a wrong first field, uT, and the way from the start over which it is
/// doubted, m.
constexpr double kTooMuchForABuilding = 20.0;
constexpr double kStartLength = 5.0;
/// Deviations of a bias that no good gyroscope has.
constexpr double kBadGyroscope = 5.0;
/// A field's share in what is learned of their noise.
constexpr double kNoiseGain = 0.025;

}  // namespace

void DeadReckoning::take(const MeanField& field) {
  if (p_(kLag, kLag) > square(kLostSigma)) find_lag_again(field);
  pass_disturbance();
  if (!yaw_is_absolute_ && known_) doubt_first(field);
  doubt_impossible(field);
  const Vector2d north = Eigen::Rotation2Dd(-x_[kLag]) * x_.segment<2>(kNorth);
  FieldRows rows = FieldRows::Zero();
  rows.col(kLag) = Vector2d(north.y(), -north.x());
  rows.block<2, 2>(0, kNorth) = Eigen::Rotation2Dd(-x_[kLag]).toRotationMatrix();
  rows.block<2, 3>(0, kIron) = field.level_rows;
  rows.block<2, 2>(0, kDisturbance).setIdentity();
  const Vector2d innovation = field.horizontal_ut - north -
                              field.level_rows * x_.segment<3>(kIron) - x_.segment<2>(kDisturbance);
  const Eigen::Matrix<double, kSize, 2> projected = p_ * rows.transpose();
  const double noise = learn_noise(field.horizontal_ut);
  const Matrix2d weight = (rows * projected + noise * Matrix2d::Identity()).inverse();
  if (yaw_is_absolute_ && innovation.dot(weight * innovation) > field_.gate) {
    restart_disturbance(innovation);
    return;
  }
  const Eigen::Matrix<double, kSize, 2> gain = projected * weight;
  if (yaw_is_absolute_) {
    correct(gain * innovation);
  } else {
    x_ += gain * innovation;
    yaw_is_absolute_ = true;
  }
  const Matrix kept = Matrix::Identity() - gain * rows;
  p_ = (kept * p_ * kept.transpose() + noise * gain * gain.transpose()).eval();
  doubt_gyroscope();
  doubt_calibration();
}

/// The iron found differs from none by more than what was taken for granted of it allows: an
/// uncalibrated board's.
void DeadReckoning::doubt_calibration() {
  const double surprise =
      surprise_of(x_.segment<3>(kIron), suspected_iron_ut2_, p_.block<3, 3>(kIron, kIron));
  // Among magnets, where fields were taken anew, it is the less sure what their misfits tell.
  const double most = kSurprise * (1.0 + static_cast<double>(field_restarts_));
  if (surprise > most) suspect_iron(square(kUncalibratedIron_ut));
}

/// A bias far beyond what a board was trusted to have, be it that gravity showed it in the level
/// axes or the field about the vertical, is a bad gyroscope's: its other axes are no better.
void DeadReckoning::doubt_gyroscope() {
  const double found = x_.segment<3>(kBias).cwiseAbs().maxCoeff();
  if (doubts_gyroscope_ || found < kBadGyroscope * config_.bias_sigma_radps) return;
  doubts_gyroscope_ = true;
  auto variance = p_.diagonal().segment<3>(kBias);
  variance = variance.cwiseMax(square(kUncalibratedBias_radps));
}

/// Variance of a mean field: neighbours differ by noise, and by little else.
double DeadReckoning::learn_noise(const Vector2d& horizontal_ut) {
  const double least = square(field_.noise_ut);
  if (last_field_) {
    const double differing = (horizontal_ut - *last_field_).squaredNorm();
    const double seen = 0.25 * std::min(differing, square(field_.restart_sigma_ut));
    field_noise_ut2_ += kNoiseGain * (std::max(seen, least) - field_noise_ut2_);
  } else {
    field_noise_ut2_ = least;
  }
  last_field_ = horizontal_ut;
  return field_noise_ut2_;
}

/// After a gap too long to know the turn in it: the field's direction tells, roughly.
void DeadReckoning::find_lag_again(const MeanField& field) {
  if (yaw_is_absolute_) {
    const Vector2d north = x_.segment<2>(kNorth);
    const Vector2d seen = field.horizontal_ut;
    x_[kLag] = std::atan2(seen.x(), seen.y()) - std::atan2(north.x(), north.y());
  }
  forget(kLag);
  p_(kLag, kLag) = square(kFoundSigma);
}

void DeadReckoning::pass_disturbance() {
  const double kept = std::exp(-since_field_m_ / field_.disturbance_length_m);
  since_field_m_ = 0.0;
  // One that is far larger than usual changes by as much.
  const double size = std::max(square(field_.disturbance_sigma_ut),
                               0.25 * x_.segment<2>(kDisturbance).squaredNorm());
  x_.segment<2>(kDisturbance) *= kept;
  p_.middleRows<2>(kDisturbance) *= kept;
  p_.middleCols<2>(kDisturbance) *= kept;
  p_.diagonal().segment<2>(kDisturbance).array() += size * (1.0 - kept * kept);
}

/// A walk may begin beside steel: a disturbance as large as the part of it that shows.
void DeadReckoning::doubt_first(const MeanField& field) {
  suspect_disturbance(known_->disturbance_ut2(field.horizontal_ut.norm(), field.up_ut));
}

/// What the earth has nowhere is a disturbance at least as large as what is too much or too little.
void DeadReckoning::doubt_impossible(const MeanField& field) {
  suspect_disturbance(impossible_ut2(std::hypot(field.horizontal_ut.norm(), field.up_ut)));
}

/// As if the filter had been as unsure of it from the start, and with it of everything learned from
/// the fields that it is in: the old prior is taken back and the new one given.
void DeadReckoning::suspect_iron(double variance_ut2) {
  if (!(variance_ut2 > suspected_iron_ut2_)) return;
  const Eigen::Matrix3d before = p_.block<3, 3>(kIron, kIron);
  const Eigen::Matrix3d information = before.inverse();
  const double taken_back = 1.0 / suspected_iron_ut2_ - 1.0 / variance_ut2;
  const Eigen::Matrix3d after = (information - taken_back * Eigen::Matrix3d::Identity()).inverse();
  const Eigen::Matrix<double, kSize, 3> lever = p_.middleCols<3>(kIron) * information;
  const Eigen::Vector3d iron = x_.segment<3>(kIron);
  correct(lever * (after * information * iron - iron));
  p_ += lever * (after - before) * lever.transpose();
  suspected_iron_ut2_ = variance_ut2;
}

/// There is one of this variance at least, each direction.
void DeadReckoning::suspect_disturbance(double variance_ut2) {
  auto variance = p_.diagonal().segment<2>(kDisturbance);
  variance = variance.cwiseMax(variance_ut2);
}

void DeadReckoning::restart_disturbance(const Vector2d& innovation_ut) {
  // Right after the start it is as likely the first fields that were wrong: a walk begins at a desk
  // of steel. A building itself does not change so much within metres.
  if (field_restarts_ == 0 && innovation_ut.norm() > kTooMuchForABuilding) {
    p_.diagonal().segment<2>(kNorth).array() +=
        square(field_.restart_sigma_ut) * std::exp(-path_length_ / kStartLength);
  }
  x_.segment<2>(kDisturbance) += innovation_ut;
  p_.middleRows<2>(kDisturbance).setZero();
  p_.middleCols<2>(kDisturbance).setZero();
  p_.diagonal().segment<2>(kDisturbance).setConstant(square(field_.restart_sigma_ut));
  ++field_restarts_;
}

}  // namespace vpdr::pdr
