// What the magnetometer tells the attitude filter.
#include <algorithm>

#include "core/rotation.hpp"
#include "core/square.hpp"
#include "pdr/core/attitude/attitude_filter.hpp"
#include "pdr/core/attitude/field_average.hpp"
#include "pdr/core/attitude/initial_attitude.hpp"

namespace vpdr::pdr {

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Faster magnetometers tell nothing more: their error is the place's, not the sensor's.
constexpr TimestampNs kShortestFieldPeriod = 8'000'000;

/// Rotation matrix of -angle, by its series: to 1e-5 rad up to a quarter radian.
Matrix3d turned_back(const Vector3d& angle_rad) {
  const double square = angle_rad.squaredNorm();
  if (square > 0.0625) return exp_rotation(-angle_rad).toRotationMatrix();
  const Vector3d sine = (1.0 - square * (1.0 / 6.0)) * angle_rad;
  const Vector3d versine = (0.5 - square * (1.0 / 24.0)) * angle_rad;
  Matrix3d out = versine * angle_rad.transpose();
  out.diagonal().array() += 1.0 - square * (0.5 - square * (1.0 / 24.0));
  out(0, 1) += sine.z();
  out(1, 0) -= sine.z();
  out(2, 0) += sine.y();
  out(0, 2) -= sine.y();
  out(1, 2) += sine.x();
  out(2, 1) -= sine.x();
  return out;
}

}  // namespace

void AttitudeFilter::process(const MagSample& sample) {
  if (!config_.use_magnetometer || !sample.field_ut.allFinite()) return;
  if (pending_count_ == pending_.size()) {
    std::shift_left(pending_.begin(), pending_.end(), 1);
    --pending_count_;
    ++dropped_fields_;
  }
  pending_[pending_count_++] = sample;
}

void AttitudeFilter::take_fields(const ImuSample& sample) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pending_count_; ++i) {
    const MagSample& mag = pending_[i];
    const double age_s = to_seconds(sample.stamp_ns - mag.stamp_ns);
    if (age_s <= 0.0) {
      pending_[kept++] = mag;
    } else if (age_s > kOldestField_s) {
      ++dropped_fields_;
    } else {
      take_field(mag, age_s);
    }
  }
  pending_count_ = kept;
}

void AttitudeFilter::take_field(const MagSample& sample, double age_s) {
  const TimestampNs since = sample.stamp_ns - last_field_ns_;
  if (has_field_ && since >= 0 && since < kShortestFieldPeriod) return;
  has_field_ = true;
  last_field_ns_ = sample.stamp_ns;
  const Vector3d turned_since = rate_ * (age_s + magnetic_.delay_s());
  const Matrix3d rotation = rotation_.lazyProduct(turned_back(turned_since));
  fields_.field_ut += rotation * sample.field_ut;
  fields_.slope_utps += rotation * sample.field_ut.cross(rate_);
  fields_.world_from_body += rotation;
  ++fields_.count;
}

void AttitudeFilter::correct_heading() {
  const MagneticReference::Readings readings{fields_.field_ut / fields_.count,
                                             fields_.slope_utps / fields_.count,
                                             fields_.world_from_body / fields_.count};
  const MagneticReference::Judgement judgement = magnetic_.judge(readings, field_interval_s_);
  error_.set_timing_variance(
      magnetic_.delay().inertial_variance_s2(square(config_.error.timing_sigma_s)));
  fields_ = {};
  field_interval_s_ = 0.0;
  if (judgement.stale_rad2 > 0.0) error_.add_heading_variance(judgement.stale_rad2);
  if (!judgement.usable) return;
  if (!yaw_is_absolute_) {
    align_heading(judgement);
    return;
  }
  error_.correct_heading(judgement.innovation_rad, judgement.variance_rad2, judgement.tilt_row);
}

void AttitudeFilter::align_heading(const MagneticReference::Judgement& judgement) {
  apply_correction();
  const Quaterniond body_from_world = world_from_body_.conjugate();
  const Quaterniond aligned =
      turn_about_vertical(-config_.magnetic.declination_rad) *
      initial_attitude(body_from_world * Vector3d::UnitZ(), body_from_world * judgement.field_ut);
  // Only the turn about the vertical is taken: the horizon is the accelerometer's affair.
  const double angle = yaw_of(aligned * body_from_world);
  const Quaterniond turn = turn_about_vertical(angle);
  world_from_body_ = turn * world_from_body_;
  error_.align_heading(angle, judgement.variance_rad2);
  magnetic_.turn(turn.toRotationMatrix());
  horizon_watch_.turn(turn.toRotationMatrix());
  last_heading_correction_ += angle;
  yaw_is_absolute_ = true;
  just_aligned_ = true;
}

}  // namespace vpdr::pdr
