#include "pdr/core/pdr.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {

/// Direction error when the mean forward direction is this clear: none at 1, any at 0.
double clarity_sigma(double clarity) { return (1.0 - clarity) * kPi; }

}  // namespace

Pdr::Pdr(const PdrConfig& config)
    : config_(config),
      imu_gate_(config.limits),
      mag_gate_(config.limits),
      attitude_(config.attitude),
      steps_(config.step, config.carry),
      dead_reckoning_(config.dead_reckoning) {}

Refusal Pdr::process(const ImuSample& sample, PdrOutput& output) {
  output = PdrOutput{};
  const Refusal refusal = imu_gate_.check(sample);
  if (refusal != Refusal::kNone) return refusal;

  attitude_.process(sample);
  follow_heading(sample);
  steps_.add(sample.stamp_ns, sample.specific_force_mps2, sample.angular_velocity_radps);
  while (const auto detected = steps_.take()) {
    if (detected->status != StepStatus::kConfirmed) continue;
    output.step = take_step(*detected);
    break;
  }
  if (heading_is_due(sample.stamp_ns) || output.step) output.heading = heading_at(sample.stamp_ns);
  output.attitude = attitude_.estimate();
  output.odometry = odometry(*output.attitude);
  return Refusal::kNone;
}

Refusal Pdr::process(const MagSample& sample) {
  const Refusal refusal = mag_gate_.check(sample);
  if (refusal == Refusal::kNone) attitude_.process(sample);
  return refusal;
}

void Pdr::follow_heading(const ImuSample& sample) {
  if (attitude_.just_aligned()) {
    const double turn = attitude_.last_heading_correction_rad();
    heading_.turn(turn);
    dead_reckoning_.turn(turn);
    last_step_yaw_rad_ = wrap_pi(last_step_yaw_rad_ + turn);
  }
  heading_.add(sample.stamp_ns, attitude_.world_from_body());
}

StepEvent Pdr::take_step(const DetectedStep& detected) {
  const WalkingHeading::Mean direction = heading_.mean(detected.previous_ns, detected.stamp_ns);
  const StepLength length = step_length(config_.step_length, detected.frequency_hz);
  const double yaw_sigma = std::sqrt(attitude_.estimate().covariance_rad2(2, 2));
  const double heading_sigma =
      std::hypot(yaw_sigma, config_.heading.forward_sigma_rad, clarity_sigma(direction.clarity));

  DeadReckonedStep step;
  step.length_m = length.length_m;
  step.yaw_rad = direction.yaw_rad;
  step.elapsed_s = step_count_ > 0 ? to_seconds(detected.stamp_ns - last_step_.stamp_ns) : 0.0;
  step.scale_sigma = config_.step_length.scale_sigma;
  step.length_noise_m = config_.step_length.step_sigma * length.length_m;
  step.heading_sigma_rad = heading_sigma;
  step.heading_noise_rad = config_.heading.sway_sigma_rad;
  dead_reckoning_.add(step);

  StepEvent event;
  event.stamp_ns = detected.stamp_ns;
  event.index = ++step_count_;
  event.length_m = length.length_m;
  event.length_sigma_m = length.sigma_m;
  event.frequency_hz = detected.frequency_hz;
  event.yaw_rad = direction.yaw_rad;
  event.yaw_sigma_rad = std::min(std::hypot(heading_sigma, config_.heading.sway_sigma_rad), kPi);
  last_step_ = detected;
  last_step_length_m_ = length.length_m;
  last_step_yaw_rad_ = direction.yaw_rad;
  yaw_share_ = yaw_sigma / heading_sigma;
  return event;
}

HeadingEstimate Pdr::heading_at(TimestampNs stamp_ns) const {
  const double window_s =
      steps_.walking() ? 1.0 / last_step_.frequency_hz : config_.heading.window_s;
  const WalkingHeading::Mean mean = heading_.mean(stamp_ns - to_ns(window_s), stamp_ns);
  const AttitudeEstimate attitude = attitude_.estimate();
  HeadingEstimate out;
  out.stamp_ns = stamp_ns;
  out.yaw_rad = mean.clarity > 0.0 ? mean.yaw_rad : yaw_of(attitude.world_from_body);
  out.yaw_sigma_rad =
      std::min(kPi, std::hypot(std::sqrt(attitude.covariance_rad2(2, 2)),
                               config_.heading.forward_sigma_rad, clarity_sigma(mean.clarity)));
  out.yaw_is_absolute = attitude.yaw_is_absolute;
  return out;
}

bool Pdr::heading_is_due(TimestampNs stamp_ns) {
  const TimestampNs period = to_ns(config_.heading.period_s);
  const bool on_schedule =
      next_heading_ && std::abs(to_seconds(stamp_ns - *next_heading_)) < config_.heading.period_s;
  if (on_schedule && stamp_ns < *next_heading_) return false;
  next_heading_ = (on_schedule ? *next_heading_ : stamp_ns) + period;
  return true;
}

PoseEstimate Pdr::odometry(const AttitudeEstimate& attitude) const {
  PoseEstimate pose;
  pose.stamp_ns = attitude.stamp_ns;
  pose.world_from_body = attitude.world_from_body;
  pose.angular_velocity_radps = attitude.angular_velocity_radps;
  pose.position_m.head<2>() = dead_reckoning_.position_m();
  if (step_count_ > 0) {
    // The body moves on after a peak; half a step at most is taken ahead of the next one.
    const double speed = last_step_length_m_ * last_step_.frequency_hz;
    const double since = to_seconds(attitude.stamp_ns - last_step_.stamp_ns);
    const double ahead = std::clamp(speed * since, 0.0, 0.5 * last_step_length_m_);
    pose.position_m.x() += ahead * std::cos(last_step_yaw_rad_);
    pose.position_m.y() += ahead * std::sin(last_step_yaw_rad_);
    pose.speed_mps = steps_.walking() ? speed : 0.0;
  }
  pose.covariance = odometry_covariance(attitude);
  return pose;
}

Matrix6d Pdr::odometry_covariance(const AttitudeEstimate& attitude) const {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.bottomRightCorner<3, 3>() = attitude.covariance_rad2;
  covariance(2, 2) = dead_reckoning_.height_variance_m2();
  // Only the attitude's share of the heading error is the attitude's yaw error.
  const Eigen::Vector2d with_yaw =
      dead_reckoning_.heading_leverage_m() * yaw_share_ * std::sqrt(attitude.covariance_rad2(2, 2));
  covariance.block<2, 1>(0, 5) = with_yaw;
  covariance.block<1, 2>(5, 0) = with_yaw.transpose();
  covariance.topLeftCorner<2, 2>() = dead_reckoning_.covariance_m2() + body_about_steps();
  return covariance;
}

Eigen::Matrix2d Pdr::body_about_steps() const {
  const DeadReckoningConfig& config = config_.dead_reckoning;
  Eigen::Matrix2d spread = config.sway_sigma_m * config.sway_sigma_m * Eigen::Matrix2d::Identity();
  if (steps_.walking()) {  // anywhere within the step under way
    const Eigen::Vector2d along(std::cos(last_step_yaw_rad_), std::sin(last_step_yaw_rad_));
    spread += last_step_length_m_ * last_step_length_m_ / 12.0 * along * along.transpose();
  } else {  // a walk may have begun, in any direction
    const double begun = config.unconfirmed_sigma_m * 2.0;
    spread += begun * begun * Eigen::Matrix2d::Identity();
  }
  return spread;
}

}  // namespace vpdr::pdr
