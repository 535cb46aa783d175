#include "pdr/core/attitude/attitude_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "core/square.hpp"
#include "pdr/core/attitude/initial_attitude.hpp"
#include "pdr/core/attitude/unseen_motion.hpp"

namespace vpdr::pdr {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Below these a reading is no sensor's limit: 1.4 g; 230 deg/s.
constexpr double kLeastForceLimit = 14.0;
constexpr double kLeastRateLimit = 4.0;
/// The rate beyond a limit, and the force, go on for about so long, s.
constexpr double kSaturationTime = 0.1;
/// Whatever tilted the horizon so far may have turned the heading as well, rad.
constexpr double kLostTurn = 1.0;
/// A horizon less sure than this needs no telling that it is wrong, rad.
constexpr double kSureTilt = 0.15;

/// exp_rotation() by its series: to 1e-6 rad up to half a radian, without trigonometry.
Quaterniond small_rotation(const Vector3d& angle_rad) {
  const double square = angle_rad.squaredNorm();
  if (square > 0.25) return exp_rotation(angle_rad);
  const double half_sinc = 0.5 - square * (1.0 / 48.0 - square * (1.0 / 3840.0));
  const double cosine = 1.0 - square * (1.0 / 8.0 - square * (1.0 / 384.0));
  const Vector3d vector = half_sinc * angle_rad;
  return {cosine, vector.x(), vector.y(), vector.z()};
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
  lost_turn_rad2_ = 0.0;
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
  if (has_gyro) watch_frozen(sample, dt_s);
  const Vector3d alive = has_gyro ? frozen_.alive() : Vector3d(Vector3d::Zero());
  const Vector3d rate = (sample.angular_velocity_radps - bias_radps())
                            .cwiseProduct(error_.scale())
                            .cwiseProduct(alive);
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

/// Until it is noticed, what a stuck axis tells is wrong by as much.
void AttitudeFilter::watch_frozen(const ImuSample& sample, double dt_s) {
  const bool was_frozen = frozen_.frozen_s() > 0.0;
  frozen_.add(sample.angular_velocity_radps, dt_s);
  const double frozen_s = frozen_.frozen_s();
  if (!(frozen_s > 0.0)) return;
  const double rate = config_.gap_rate_radps;
  lost_turn_rad2_ = 2.0 * square(rate) * frozen_s * dt_s;
  if (!was_frozen) lost_turn_rad2_ += square(sample.angular_velocity_radps.norm() * frozen_s);
  error_.add_attitude_variance(lost_turn_rad2_);
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
  restart_surroundings();
  rate_ = sample.angular_velocity_radps - bias_radps();
  // Heading is held; inclination starts anew from what the accelerometer says now.
  const Vector3d force_world = world_from_body_ * sample.specific_force_mps2;
  if (force_world.norm() > 0.0) {
    world_from_body_ =
        Quaterniond::FromTwoVectors(force_world, Vector3d::UnitZ()) * world_from_body_;
  }
  rotation_ = world_from_body_.toRotationMatrix();
}

void AttitudeFilter::correct(bool has_gyro) {
  motion_.has_gyro = has_gyro;
  error_.predict(motion_);
  if (levelling_.duration_s() < config_.levelling_s) {
    level_coarsely();
  } else if (horizon_is_lost(has_gyro)) {
    return lose_horizon();
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

/// A horizon that is known to be unsure finds itself.
bool AttitudeFilter::horizon_is_lost(bool has_gyro) {
  const bool impossible = horizon_watch_.add(motion_.velocity_mps, motion_.duration_s);
  return impossible && has_gyro && error_.tilt_variance_rad2() < square(kSureTilt);
}

/// It is levelled as at the start.
void AttitudeFilter::lose_horizon() {
  error_.restart(kLostTurn);
  error_.doubt_gyroscope();
  restart_surroundings();
  lost_turn_rad2_ = square(kLostTurn);
}

/// What was gathered before means nothing after.
void AttitudeFilter::restart_surroundings() {
  levelling_.restart();
  horizon_watch_.restart();
  rest_.reset();
  magnetic_.restart();
  motion_ = {};
  fields_ = {};
}

void AttitudeFilter::apply_correction() {
  const Vector3d turn = error_.take_turn();
  const Quaterniond correction = small_rotation(turn);
  world_from_body_ = (correction * world_from_body_).normalized();
  magnetic_.turn(correction.toRotationMatrix());
  horizon_watch_.turn(correction.toRotationMatrix());
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
