#include "pdr/core/attitude/magnetic_offset.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/square.hpp"

namespace vpdr::pdr {

namespace {
/// One misfit widens the spread at most as one of this many variances: magnets come suddenly.
constexpr double kLargestMisfit = 25.0;
}  // namespace

MagneticOffset::MagneticOffset(const MagneticOffsetConfig& config)
    : config_(config),
      spread_ut2_(config.least_sigma_ut * config.least_sigma_ut),
      covariance_(config.prior_sigma_ut * config.prior_sigma_ut * Eigen::Matrix3d::Identity()) {}

void MagneticOffset::add(const Eigen::Vector3d& field_world_ut,
                         const Eigen::Matrix3d& world_from_body, double dt_s) {
  double share = 1.0;
  if (weight_s_ > 0.0) {
    share = weight_of(misfit_ut(field_world_ut, world_from_body).squaredNorm() / 3.0, dt_s);
  }
  const double keep = std::max(0.0, 1.0 - dt_s / config_.memory_s);
  weight_s_ = keep * weight_s_ + share * dt_s;
  const double gain = share * dt_s / weight_s_;
  rotation_ += gain * (world_from_body - rotation_);
  world_ += gain * (field_world_ut - world_);
  body_ += gain * (world_from_body.transpose() * field_world_ut - body_);

  // Variance of the means, readings within a correlation time being one.
  const double alike_s = 2.0 * config_.correlation_s;
  const double noise = spread_ut2_ * alike_s / std::max(weight_s_, alike_s);
  const double prior = noise / (square(config_.prior_sigma_ut) + offset_.squaredNorm() / 3.0);
  const Eigen::Matrix3d information =
      (1.0 + prior) * Eigen::Matrix3d::Identity() - rotation_.transpose() * rotation_;
  const Eigen::Matrix3d inverse = information.inverse();
  offset_ = inverse * (body_ - rotation_.transpose() * world_ + prior * prior_offset_);
  covariance_ = noise * inverse;
  field_ = world_ - rotation_ * offset_;
}

double MagneticOffset::weight_of(double misfit_ut2, double dt_s) {
  const double share = misfit_ut2 > spread_ut2_ ? spread_ut2_ / misfit_ut2 : 1.0;
  const double bounded = std::min(misfit_ut2, kLargestMisfit * spread_ut2_);
  spread_ut2_ += std::min(1.0, dt_s / config_.spread_memory_s) * (bounded - spread_ut2_);
  spread_ut2_ = std::max(spread_ut2_, config_.least_sigma_ut * config_.least_sigma_ut);
  return share;
}

void MagneticOffset::restart() {
  weight_s_ = 0.0;
  prior_offset_ = offset_;
}

void MagneticOffset::turn(const Eigen::Matrix3d& world_from_old_world) {
  rotation_ = (world_from_old_world * rotation_).eval();
  world_ = (world_from_old_world * world_).eval();
  field_ = (world_from_old_world * field_).eval();
}

}  // namespace vpdr::pdr
