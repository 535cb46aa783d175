#include "pdr/core/attitude/magnetic_offset.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/square.hpp"
#include "pdr/core/attitude/known_field.hpp"
#include "pdr/core/attitude/uncalibrated.hpp"

namespace vpdr::pdr {

namespace {
/// One misfit widens the spread at most as one of this many variances: magnets come suddenly.
constexpr double kLargestMisfit = 25.0;
/// Misfits as large as so many of the least variances are looked into.
constexpr double kMisfit = 4.0;
/// How many times smaller they are when iron is their cause: chance explains six numbers' worth of
/// readings (two correlation times) by three of iron, but not nearly all of them.
constexpr double kExplained = 20.0;
}  // namespace

MagneticOffset::MagneticOffset(const MagneticOffsetConfig& config)
    : config_(config),
      spread_ut2_(config.least_sigma_ut * config.least_sigma_ut),
      prior_ut2_(config.prior_sigma_ut * config.prior_sigma_ut),
      covariance_(config.prior_sigma_ut * config.prior_sigma_ut * Eigen::Matrix3d::Identity()) {}

void MagneticOffset::add(const Eigen::Vector3d& field_world_ut,
                         const Eigen::Matrix3d& world_from_body, double dt_s) {
  double share = 1.0;
  if (weight_s_ > 0.0) {
    share = weight_of(misfit_ut(field_world_ut, world_from_body).squaredNorm() / 3.0, dt_s);
  } else {
    // Later it may as well be a magnet that came near.
    prior_ut2_ = std::max(prior_ut2_, impossible_ut2(field_world_ut.norm()));
  }
  const double keep = std::max(0.0, 1.0 - dt_s / config_.memory_s);
  weight_s_ = keep * weight_s_ + share * dt_s;
  const double gain = share * dt_s / weight_s_;
  rotation_ += gain * (world_from_body - rotation_);
  world_ += gain * (field_world_ut - world_);
  body_ += gain * (world_from_body.transpose() * field_world_ut - body_);

  strength_ut2_ += gain * (field_world_ut.squaredNorm() - strength_ut2_);

  const Normal normal{Eigen::Matrix3d::Identity() - rotation_.transpose() * rotation_,
                      body_ - rotation_.transpose() * world_};
  if (spread_ut2_ > kMisfit * square(config_.least_sigma_ut)) suspect_iron(normal);

  // Variance of the means, readings within a correlation time being one.
  const double alike_s = 2.0 * config_.correlation_s;
  const double noise = spread_ut2_ * alike_s / std::max(weight_s_, alike_s);
  const double prior = noise / (prior_ut2_ + offset_.squaredNorm() / 3.0);
  const Eigen::Matrix3d information = normal.information + prior * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d inverse = information.inverse();
  offset_ = inverse * (normal.moment_ut + prior * prior_offset_);
  covariance_ = noise * inverse;
  field_ = world_ - rotation_ * offset_;
}

/// Large misfits are a magnet's, unless an uncalibrated board's iron explains nearly all of them.
void MagneticOffset::suspect_iron(const Normal& normal) {
  const double least = square(config_.least_sigma_ut);
  const double now = misfit_ut2(normal, offset_);
  if (now < kExplained * least) return;
  const Eigen::Matrix3d information =
      normal.information + least / square(kUncalibratedIron_ut) * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d iron = information.inverse() * normal.moment_ut;
  const double left = std::max(misfit_ut2(normal, iron), least);
  if (now < kExplained * left) return;
  prior_ut2_ = std::max(prior_ut2_, iron.squaredNorm());
  spread_ut2_ = left;
}

/// Mean over the memory, of one axis.
double MagneticOffset::misfit_ut2(const Normal& normal, const Eigen::Vector3d& offset_ut) const {
  return (strength_ut2_ - world_.squaredNorm() +
          offset_ut.dot(normal.information * offset_ut - 2.0 * normal.moment_ut)) /
         3.0;
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
