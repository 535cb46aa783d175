#include "pdr/core/attitude/relative_attitude.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/rotation.hpp"
#include "pdr/core/attitude/unseen_motion.hpp"

namespace vpdr::pdr {

namespace {

using Eigen::Vector3d;

/// A scale of the gyroscope is found where a heading holds it. Here nothing would: it would run
/// away within the hour, and the yaw with it.
constexpr double kScaleSigma = 5e-4;

AttitudeConfig without_magnetometer(AttitudeConfig config) {
  config.use_magnetometer = false;
  config.error.initial_scale_sigma = std::min(config.error.initial_scale_sigma, kScaleSigma);
  return config;
}

}  // namespace

RelativeAttitude::RelativeAttitude(AttitudeConfig config)
    : config_(config), filter_(without_magnetometer(config)), rest_(config.rest) {}

void RelativeAttitude::process(const ImuSample& sample) {
  filter_.process(sample);
  turned_by_filter_ = wrap_pi(turned_by_filter_ + filter_.last_heading_correction_rad());
  const Eigen::AngleAxisd back(-turned_by_filter_, Vector3d::UnitZ());
  odom_from_body_ = (back * filter_.world_from_body()).normalized();
  if (last_stamp_) note_passed(sample);
  last_stamp_ = sample.stamp_ns;
  rate_ = sample.has_angular_velocity ? Vector3d(sample.angular_velocity_radps - bias_)
                                      : Vector3d(Vector3d::Zero());
}

double RelativeAttitude::tilt_variance_rad2() const {
  return filter_.estimate().covariance_rad2(0, 0);
}

void RelativeAttitude::note_passed(const ImuSample& sample) {
  const double dt = to_seconds(sample.stamp_ns - *last_stamp_);
  const bool gap = dt > config_.gap_s || dt <= 0.0;
  motion_.blind_rad2 += filter_.lost_turn_rad2();
  motion_.elapsed_s += std::max(dt, 0.0);
  if (gap) {
    const double turned = std::min(config_.gap_rate_radps * std::abs(dt), kPi);
    motion_.blind_rad2 += turned * turned;
    motion_.gap_s += std::abs(dt);
    rest_.reset();
  } else if (!sample.has_angular_velocity) {
    motion_.blind_rad2 += config_.error.no_gyro_rate_radps * config_.error.no_gyro_rate_radps * dt;
  } else {
    motion_.turned_rad += rate_.norm() * dt;
    motion_.blind_rad2 += unseen_turn_rad2(dt, kUnseenYawRate_radps);
    rest_.add(sample.angular_velocity_radps, sample.specific_force_mps2, dt);
    note_rest();
  }
  motion_.up_s += std::max(dt, 0.0) * (odom_from_body_.conjugate() * Vector3d::UnitZ());
  motion_.bias_change_radps += filter_.bias_radps() - bias_;
  bias_ = filter_.bias_radps();
}

void RelativeAttitude::note_rest() {
  if (!rest_.take_new_rest_block()) return;
  // What is left of it as the caller knows it, without the changes it has not been told of yet.
  motion_.rest_bias_radps = rest_.mean_rate_radps() - bias_ + motion_.bias_change_radps;
}

RelativeMotion RelativeAttitude::take_motion() { return std::exchange(motion_, RelativeMotion{}); }

}  // namespace vpdr::pdr
