#include "pdr/core/attitude_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "core/square.hpp"
#include "pdr/core/field_average.hpp"
#include "pdr/core/initial_attitude.hpp"
#include "pdr/core/unseen_motion.hpp"

namespace vpdr::pdr {

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Faster magnetometers tell nothing more: their error is the place's, not the sensor's.
constexpr TimestampNs kShortestFieldPeriod = 8'000'000;
/// Below these a reading is no sensor's limit: 1.4 g; 230 deg/s.
constexpr double kLeastForceLimit = 14.0;
constexpr double kLeastRateLimit = 4.0;
/// The rate beyond a limit, and the force, go on for about so long, s.
constexpr double kSaturationTime = 0.1;

Quaterniond turn_about_vertical(double angle_rad) {
  return Quaterniond(Eigen::AngleAxisd(angle_rad, Vector3d::UnitZ()));
}

/// exp_rotation() by its series: to 1e-6 rad up to half a radian, without trigonometry.
Quaterniond small_rotation(const Vector3d& angle_rad) {
  const double square = angle_rad.squaredNorm();
  if (square > 0.25) return exp_rotation(angle_rad);
  const double half_sinc = 0.5 - square * (1.0 / 48.0 - square * (1.0 / 3840.0));
  const double cosine = 1.0 - square * (1.0 / 8.0 - square * (1.0 / 384.0));
  const Vector3d vector = half_sinc * angle_rad;
  return {cosine, vector.x(), vector.y(), vector.z()};
}

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

AttitudeFilter::AttitudeFilter(const AttitudeConfig& config)
    : config_(config),
      error_(config.error),
      magnetic_(config.magnetic),
      rest_(config.rest),
      force_limit_(kLeastForceLimit),
      rate_limit_(kLeastRateLimit),
      complementary_(config.complementary) {}

void AttitudeFilter::process(const ImuSample& sample) {
  if (!sample.specific_force_mps2.allFinite() || !sample.angular_velocity_radps.allFinite()) return;
  just_aligned_ = false;
  last_heading_correction_ = 0.0;
  const bool first = !initialised_;
  if (first) initialise(sample);
  const double dt_s = to_seconds(sample.stamp_ns - last_sample_.stamp_ns);
  if (config_.filter == AttitudeMethod::kComplementary) {
    step_complementary(sample, std::clamp(dt_s, 0.0, config_.gap_s));
    return;
  }
  if (first) return;
  if (dt_s > config_.gap_s || dt_s <= 0.0) {
    pass_gap(sample, std::abs(dt_s));
  } else {
    integrate(sample, dt_s);
  }
  take_fields(sample);
  last_sample_ = sample;
  if (motion_.duration_s >= config_.correction_period_s) correct(sample.has_angular_velocity);
}

void AttitudeFilter::process(const MagSample& sample) {
  if (!config_.use_magnetometer || !sample.field_ut.allFinite()) return;
  if (pending_count_ == pending_.size()) {
    std::shift_left(pending_.begin(), pending_.end(), 1);
    --pending_count_;
    ++dropped_fields_;
  }
  pending_[pending_count_++] = sample;
}

AttitudeEstimate AttitudeFilter::estimate() const {
  AttitudeEstimate out;
  out.stamp_ns = last_sample_.stamp_ns;
  out.specific_force_mps2 = last_sample_.specific_force_mps2;
  out.angular_velocity_radps = rate_;
  out.world_from_body = world_from_body_;
  out.covariance_rad2 = complementary_.covariance_rad2();
  if (config_.filter == AttitudeMethod::kErrorState) {
    out.world_from_body =
        (world_from_body_ * small_rotation(rate_ * config_.sensor_delay_s)).normalized();
    out.covariance_rad2 = error_.covariance_rad2(world_from_body_ * rate_);
  }
  out.yaw_is_absolute = yaw_is_absolute_;
  out.gyro_bias_radps = bias_radps();
  out.at_rest = at_rest();
  out.magnetically_disturbed = magnetically_disturbed();
  return out;
}

void AttitudeFilter::initialise(const ImuSample& sample) {
  world_from_body_ = level_attitude(sample.specific_force_mps2);
  complementary_.start(world_from_body_);
  last_sample_ = sample;
  rate_ = sample.angular_velocity_radps;
  initialised_ = true;
}

void AttitudeFilter::integrate(const ImuSample& sample, double dt_s) {
  const bool has_gyro = sample.has_angular_velocity;
  const Vector3d rate =
      has_gyro
          ? Vector3d((sample.angular_velocity_radps - bias_radps()).cwiseProduct(error_.scale()))
          : Vector3d(Vector3d::Zero());
  // The mean of two readings: no delay when the gyroscope samples instants.
  const Vector3d angle = 0.5 * dt_s * (rate_ + rate);
  rate_ = rate;
  world_from_body_ = world_from_body_ * small_rotation(angle);

  rotation_ = world_from_body_.toRotationMatrix();
  motion_.duration_s += dt_s;
  motion_.rotation += dt_s * rotation_;
  motion_.turn += rotation_ * angle.asDiagonal();
  motion_.velocity_mps += rotation_ * (dt_s * sample.specific_force_mps2);
  motion_.turned_rad += angle.norm();
  if (dt_s > kSeen_s) {
    error_.add_attitude_variance(unseen_turn_rad2(dt_s));
    error_.add_velocity_variance(unseen_velocity_m2ps2(dt_s));
  }
  watch_limits(sample, dt_s);
  if (has_gyro) rest_.add(sample.angular_velocity_radps, sample.specific_force_mps2, dt_s);
}

void AttitudeFilter::watch_limits(const ImuSample& sample, double dt_s) {
  if (force_limit_.add(sample.specific_force_mps2)) {
    const double hidden = config_.saturated_force_mps2;
    error_.add_velocity_variance(hidden * hidden * kSaturationTime * dt_s);
  }
  if (rate_limit_.add(sample.angular_velocity_radps)) {
    const double hidden = config_.saturated_rate_radps;
    error_.add_attitude_variance(hidden * hidden * kSaturationTime * dt_s);
  }
}

void AttitudeFilter::pass_gap(const ImuSample& sample, double gap_s) {
  error_.restart(std::min(config_.gap_rate_radps * gap_s, kPi));
  levelling_.restart();
  rest_.reset();
  magnetic_.restart();
  motion_ = {};
  fields_ = {};
  rate_ = sample.angular_velocity_radps - bias_radps();
  // Heading is held; inclination starts anew from what the accelerometer says now.
  const Vector3d force_world = world_from_body_ * sample.specific_force_mps2;
  if (force_world.norm() > 0.0) {
    world_from_body_ =
        Quaterniond::FromTwoVectors(force_world, Vector3d::UnitZ()) * world_from_body_;
  }
  rotation_ = world_from_body_.toRotationMatrix();
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

void AttitudeFilter::correct(bool has_gyro) {
  motion_.has_gyro = has_gyro;
  error_.predict(motion_);
  if (levelling_.duration_s() < config_.levelling_s) {
    level_coarsely();
  } else {
    const Vector3d expected = rotation_ * expected_mps_;
    error_.correct_velocity(motion_.duration_s, rest_.at_rest(), expected.head<2>());
  }
  if (has_gyro && rest_.take_new_rest_block()) error_.correct_at_rest(rest_.mean_rate_radps());
  field_interval_s_ += motion_.duration_s;
  motion_ = {};
  const bool due = field_interval_s_ >= config_.heading_period_s || !yaw_is_absolute_;
  if (due && fields_.count > 0) correct_heading();
  apply_correction();
}

void AttitudeFilter::level_coarsely() {
  const Quaterniond upright = levelling_.add(motion_.velocity_mps, motion_.duration_s);
  world_from_body_ = upright * world_from_body_;
  error_.level(levelling_.tilt_sigma_rad());
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
  last_heading_correction_ += angle;
  yaw_is_absolute_ = true;
  just_aligned_ = true;
}

void AttitudeFilter::apply_correction() {
  const Vector3d turn = error_.take_turn();
  const Quaterniond correction = small_rotation(turn);
  world_from_body_ = (correction * world_from_body_).normalized();
  magnetic_.turn(correction.toRotationMatrix());
  last_heading_correction_ += turn.z();
}

void AttitudeFilter::step_complementary(const ImuSample& sample, double dt_s) {
  // From the last sample on, with what was measured then.
  complementary_.step(rate_, complementary_measurement(), dt_s);
  for (std::size_t i = 0; i < pending_count_; ++i) {
    if (pending_[i].stamp_ns <= sample.stamp_ns) last_field_ut_ = pending_[i].field_ut;
  }
  pending_count_ = 0;
  last_sample_ = sample;
  rate_ = sample.angular_velocity_radps;
  if (!yaw_is_absolute_ && last_field_ut_.norm() > 0.0) {
    const double before = yaw_of(complementary_.world_from_body());
    complementary_.start(complementary_measurement());
    last_heading_correction_ = wrap_pi(yaw_of(complementary_.world_from_body()) - before);
    yaw_is_absolute_ = true;
    just_aligned_ = true;
  }
  world_from_body_ = complementary_.world_from_body();
}

Quaterniond AttitudeFilter::complementary_measurement() const {
  if (last_field_ut_.norm() > 0.0) {
    return turn_about_vertical(-config_.magnetic.declination_rad) *
           initial_attitude(last_sample_.specific_force_mps2, last_field_ut_);
  }
  // Without a field heading is the gyroscope's alone.
  const Quaterniond level = level_attitude(last_sample_.specific_force_mps2);
  return turn_about_vertical(yaw_of(complementary_.world_from_body()) - yaw_of(level)) * level;
}

}  // namespace vpdr::pdr
