#include "pdr/core/inclination_filter.hpp"

#include <algorithm>
#include <cmath>

#include "core/samples.hpp"

namespace vpdr::pdr {

namespace {

/// Time over which accelerations of a moving person stay alike, s; sets how fast they average out.
constexpr double kAccelerationCorrelation = 0.3;
/// Below this the low-passed force points nowhere: free fall.
constexpr double kLeastForce = 1.0;

}  // namespace

InclinationFilter::InclinationFilter(const InclinationConfig& config) : config_(config) {}

Eigen::Quaterniond InclinationFilter::correct(const Eigen::Vector3d& force_world_mps2, double dt_s,
                                              bool has_gyro) {
  const double tau = has_gyro ? config_.time_constant_s : config_.time_constant_without_gyro_s;
  age_s_ += dt_s;
  // While young, the gain of the running mean: all that was seen so far counts alike.
  const double gain = std::max(1.0 - std::exp(-dt_s / tau), dt_s / age_s_);
  fast_ += gain * (force_world_mps2 - fast_);
  slow_ += gain * (fast_ - slow_);
  const Eigen::Vector3d residual = force_world_mps2 - slow_;
  horizontal_variance_ += gain * (0.5 * residual.head<2>().squaredNorm() - horizontal_variance_);
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
  const double span = std::clamp(age_s_, 0.01, 2.0 * config_.time_constant_s);
  const double share = std::min(1.0, kAccelerationCorrelation / span);
  const double averaged = horizontal_variance_ * share / (kGravityMps2 * kGravityMps2);
  const double fading = start_variance_ * std::exp(-age_s_ / config_.time_constant_s);
  return config_.base_sigma_rad * config_.base_sigma_rad + averaged + fading;
}

bool InclinationFilter::settled() const { return age_s_ > 4.0 * config_.time_constant_s; }

}  // namespace vpdr::pdr
