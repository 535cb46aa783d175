#include "pdr/core/inclination_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/samples.hpp"

namespace vpdr::pdr {

namespace {

/// Time over which accelerations of a moving person stay alike, s; sets how fast they average out.
constexpr double kAccelerationCorrelation = 0.3;
/// The same of its turns, s.
constexpr double kTurningCorrelation = 1.0;
/// Over this time the kind of movement is judged, s.
constexpr double kMovementMemory = 2.0;
/// Its beginning is noticed sooner, s.
constexpr double kMovementOnset = 0.5;
/// Below this the low-passed force points nowhere: free fall.
constexpr double kLeastForce = 1.0;

}  // namespace

InclinationFilter::InclinationFilter(const InclinationConfig& config) : config_(config) {}

Eigen::Quaterniond InclinationFilter::correct(const Eigen::Vector3d& force_world_mps2,
                                              double rate_radps, double dt_s) {
  const double gain = std::min(1.0, dt_s / kMovementMemory);
  rate_variance_ += gain * (rate_radps * rate_radps - rate_variance_);
  return low_pass(force_world_mps2, time_constant_s(), dt_s);
}

Eigen::Quaterniond InclinationFilter::correct_without_gyro(const Eigen::Vector3d& force_world_mps2,
                                                           double dt_s) {
  return low_pass(force_world_mps2, config_.time_constant_without_gyro_s, dt_s);
}

double InclinationFilter::time_constant_s() const {
  const double noise =
      2.0 * kAccelerationCorrelation * horizontal_variance_ / (kGravityMps2 * kGravityMps2);
  const double turning = config_.turning_error * config_.turning_error * rate_variance_;
  const double drift =
      config_.drift_rad_sqrt_s * config_.drift_rad_sqrt_s + 2.0 * kTurningCorrelation * turning;
  return std::clamp(std::sqrt(noise / drift), config_.shortest_time_constant_s,
                    std::max(config_.shortest_time_constant_s, config_.longest_time_constant_s));
}

Eigen::Quaterniond InclinationFilter::low_pass(const Eigen::Vector3d& force_world_mps2,
                                               double time_constant_s, double dt_s) {
  age_s_ += dt_s;
  // While young, the gain of the running mean: all that was seen so far counts alike.
  const double gain = std::max(1.0 - std::exp(-dt_s / time_constant_s), dt_s / age_s_);
  fast_ += gain * (force_world_mps2 - fast_);
  slow_ += gain * (fast_ - slow_);
  const double variance = 0.5 * (force_world_mps2 - slow_).head<2>().squaredNorm();
  const double memory = variance > horizontal_variance_ ? kMovementOnset : kMovementMemory;
  horizontal_variance_ += std::min(1.0, dt_s / memory) * (variance - horizontal_variance_);
  if (slow_.norm() < kLeastForce) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond::FromTwoVectors(slow_, Eigen::Vector3d::UnitZ());
}

void InclinationFilter::turn(const Eigen::Quaterniond& world_from_old_world) {
  fast_ = world_from_old_world * fast_;
  slow_ = world_from_old_world * slow_;
}

void InclinationFilter::restart(double sigma_rad) {
  age_s_ = 0.0;
  start_variance_ = sigma_rad * sigma_rad;
}

double InclinationFilter::variance_rad2() const {
  const double span = std::clamp(age_s_, 0.01, 2.0 * time_constant_s());
  const double share = std::min(1.0, kAccelerationCorrelation / span);
  const double averaged = horizontal_variance_ * share / (kGravityMps2 * kGravityMps2);
  const double fading = start_variance_ * std::exp(-age_s_ / config_.longest_time_constant_s);
  return config_.base_sigma_rad * config_.base_sigma_rad + averaged + fading;
}

bool InclinationFilter::settled() const { return age_s_ > 2.0 * config_.longest_time_constant_s; }

}  // namespace vpdr::pdr
