#include "pdr/core/attitude_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "pdr/core/initial_attitude.hpp"

namespace vpdr::pdr {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// A field older than this when it is used has been turned too far for the last rate to undo.
constexpr double kOldestField = 0.1;

Quaterniond turn_about_vertical(double angle_rad) {
  return Quaterniond(Eigen::AngleAxisd(angle_rad, Vector3d::UnitZ()));
}

/// First-order Runge-Kutta step of q' = q (0, w) / 2 (S3.3).
Quaterniond first_order_step(const Quaterniond& q, const Vector3d& angle_rad) {
  const Quaterniond rate(0.0, angle_rad.x(), angle_rad.y(), angle_rad.z());
  const Quaterniond slope = q * rate;
  return Quaterniond(q.coeffs() + 0.5 * slope.coeffs());
}

}  // namespace

AttitudeFilter::AttitudeFilter(const AttitudeConfig& config)
    : config_(config),
      inclination_(config.inclination),
      magnetic_(config.magnetic),
      gyro_error_(config.gyro_error),
      rest_(config.rest) {}

void AttitudeFilter::process(const ImuSample& sample) {
  just_aligned_ = false;
  last_heading_correction_ = 0.0;
  if (!initialised_) {
    initialise(sample);
    return;
  }
  const double dt_s = to_seconds(sample.stamp_ns - last_sample_.stamp_ns);
  if (dt_s > config_.gap_s || dt_s <= 0.0) {
    pass_gap(sample, std::abs(dt_s));
  } else {
    integrate(sample, dt_s);
  }
  take_fields(sample);
  last_sample_ = sample;
  if (block_.duration_s >= config_.correction_period_s) correct(sample.has_angular_velocity);
}

void AttitudeFilter::process(const MagSample& sample) {
  if (!config_.use_magnetometer) return;
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
  out.world_from_body = world_from_body_;
  out.specific_force_mps2 = last_sample_.specific_force_mps2;
  if (last_sample_.has_angular_velocity) {
    out.angular_velocity_radps = last_sample_.angular_velocity_radps - bias_radps();
  }
  const double level = inclination_.variance_rad2();
  out.covariance_rad2.diagonal() << level, level, gyro_error_.heading_variance_rad2();
  out.yaw_is_absolute = yaw_is_absolute_;
  return out;
}

void AttitudeFilter::initialise(const ImuSample& sample) {
  world_from_body_ = level_attitude(sample.specific_force_mps2);
  last_sample_ = sample;
  initialised_ = true;
}

void AttitudeFilter::integrate(const ImuSample& sample, double dt_s) {
  // The mean of two readings: no delay when the gyroscope samples instants.
  const Vector3d rate =
      sample.has_angular_velocity
          ? Vector3d(0.5 * (last_sample_.angular_velocity_radps + sample.angular_velocity_radps) -
                     bias_radps())
          : Vector3d(Vector3d::Zero());
  const Vector3d angle = rate * dt_s;
  world_from_body_ = config_.integration == RateIntegration::kExponential
                         ? world_from_body_ * exp_rotation(angle)
                         : first_order_step(world_from_body_, angle);
  world_from_body_.normalize();

  const Eigen::Matrix3d rotation = world_from_body_.toRotationMatrix();
  block_.duration_s += dt_s;
  block_.force_world += rotation * sample.specific_force_mps2 * dt_s;
  block_.world_from_body += rotation * dt_s;
  block_.turned_rad += angle.norm();
  if (sample.has_angular_velocity) {
    rest_.add(sample.angular_velocity_radps, sample.specific_force_mps2, dt_s);
  } else {
    const double turned = config_.no_gyro_rate_radps;
    gyro_error_.add_heading_variance(turned * turned * dt_s);
  }
}

void AttitudeFilter::pass_gap(const ImuSample& sample, double gap_s) {
  const double turned = std::min(config_.gap_rate_radps * gap_s, kPi);
  inclination_.restart(turned);
  gyro_error_.add_heading_variance(turned * turned);
  rest_.reset();
  block_ = Block{};
  // Heading is held; inclination starts anew from what the accelerometer says now.
  const Vector3d force_world = world_from_body_ * sample.specific_force_mps2;
  if (force_world.norm() > 0.0) {
    world_from_body_ =
        Quaterniond::FromTwoVectors(force_world, Vector3d::UnitZ()) * world_from_body_;
  }
}

void AttitudeFilter::take_fields(const ImuSample& sample) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < pending_count_; ++i) {
    const MagSample& mag = pending_[i];
    const double age_s = to_seconds(sample.stamp_ns - mag.stamp_ns);
    if (age_s <= 0.0) {
      pending_[kept++] = mag;
    } else if (age_s > kOldestField) {
      ++dropped_fields_;
    } else {
      const Vector3d rate = sample.has_angular_velocity
                                ? Vector3d(sample.angular_velocity_radps - bias_radps())
                                : Vector3d(Vector3d::Zero());
      block_.field_world += world_from_body_ * (exp_rotation(-age_s * rate) * mag.field_ut);
      ++block_.fields;
    }
  }
  pending_count_ = kept;
}

void AttitudeFilter::correct(bool has_gyro) {
  const Block block = block_;
  block_ = Block{};
  gyro_error_.predict(block.duration_s, block.world_from_body.row(2).transpose() / block.duration_s,
                      block.turned_rad);
  correct_inclination(block, has_gyro);
  if (has_gyro) correct_bias_at_rest();
  field_interval_s_ += block.duration_s;
  if (block.fields > 0) correct_heading(block);
}

void AttitudeFilter::correct_inclination(const Block& block, bool has_gyro) {
  const double dt = block.duration_s;
  const double gain = 1.0 - std::exp(-dt / inclination_.time_constant_s());
  slow_level_rows_ += gain * (block.world_from_body.topRows<2>() / dt - slow_level_rows_);

  const Vector3d force = block.force_world / dt;
  const Quaterniond correction = has_gyro ? inclination_.correct(force, block.turned_rad / dt, dt)
                                          : inclination_.correct_without_gyro(force, dt);
  world_from_body_ = (correction * world_from_body_).normalized();
  inclination_.turn(correction);
  if (!has_gyro || !inclination_.settled()) return;
  const Eigen::Vector2d drift = log_rotation(correction).head<2>() / dt;
  turn_heading(gyro_error_.correct_from_drift(drift, slow_level_rows_, dt));
}

void AttitudeFilter::correct_bias_at_rest() {
  if (rest_.take_new_rest_block()) {
    turn_heading(gyro_error_.correct_at_rest(rest_.mean_rate_radps()));
  }
}

void AttitudeFilter::correct_heading(const Block& block) {
  const Vector3d field = block.field_world / block.fields;
  const MagneticReference::Judgement judgement = magnetic_.judge(field, field_interval_s_);
  field_interval_s_ = 0.0;
  if (!judgement.usable) return;
  if (!yaw_is_absolute_) {
    align_heading(field, judgement.variance_rad2);
    return;
  }
  turn_heading(gyro_error_.correct_heading(judgement.innovation_rad, judgement.variance_rad2));
}

void AttitudeFilter::align_heading(const Vector3d& field_world_ut, double variance_rad2) {
  const Quaterniond body_from_world = world_from_body_.conjugate();
  const Quaterniond aligned = turn_about_vertical(-config_.magnetic.declination_rad) *
                              initial_attitude(body_from_world * inclination_.upward_mps2(),
                                               body_from_world * field_world_ut);
  // Only the turn about the vertical is taken: the horizon is the accelerometer's affair.
  turn_heading(yaw_of(aligned * body_from_world));
  gyro_error_.set_heading_variance(variance_rad2);
  yaw_is_absolute_ = true;
  just_aligned_ = true;
}

void AttitudeFilter::turn_heading(double angle_rad) {
  if (angle_rad == 0.0) return;
  const Quaterniond turn = turn_about_vertical(angle_rad);
  world_from_body_ = (turn * world_from_body_).normalized();
  inclination_.turn(turn);
  slow_level_rows_ = (turn.toRotationMatrix().topLeftCorner<2, 2>() * slow_level_rows_).eval();
  last_heading_correction_ += angle_rad;
}

}  // namespace vpdr::pdr
