#include "pdr/core/attitude/magnetic_delay.hpp"

#include <algorithm>

#include "core/square.hpp"

namespace vpdr::pdr {

MagneticDelay::MagneticDelay(const MagneticDelayConfig& config)
    : config_(config), variance_s2_(square(config.sigma_s)) {}

void MagneticDelay::add(const Eigen::Vector3d& misfit_ut, double variance_ut2,
                        const Eigen::Vector3d& slope_utps, double dt_s) {
  // A misfit that goes on for a while is not new information each time.
  const double noise = variance_ut2 * std::max(1.0, 2.0 * config_.correlation_s / dt_s);
  // Three directions of one variance: together they weigh as the slope's square.
  const double total = noise + variance_s2_ * slope_utps.squaredNorm();
  excess_s_ -= variance_s2_ / total * slope_utps.dot(misfit_ut);
  excess_s_ = std::clamp(excess_s_, -config_.largest_s, config_.largest_s);
  variance_s2_ *= noise / total;
}

double MagneticDelay::inertial_variance_s2(double unknown_s2) const {
  const double unknown = variance_s2_ / square(config_.sigma_s);
  return unknown * unknown_s2 + square(config_.least_sigma_s) + square(excess_s_);
}

}  // namespace vpdr::pdr
