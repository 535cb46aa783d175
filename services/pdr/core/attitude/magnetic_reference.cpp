#include "pdr/core/attitude/magnetic_reference.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {
/// A field closer to vertical than this tells no heading, uT.
constexpr double kLeastHorizontal = 2.0;
}  // namespace

MagneticReference::MagneticReference(const MagneticConfig& config)
    : config_(config),
      offset_(config.offset),
      delay_(config.delay),
      disturbance_ut2_(config.initial_sigma_ut * config.initial_sigma_ut) {}

MagneticReference::Judgement MagneticReference::judge(const Readings& readings, double dt_s) {
  learn_delay(readings, dt_s);
  offset_.add(readings.field_ut, readings.world_from_body, dt_s);
  Judgement out;
  out.field_ut = readings.field_ut - readings.world_from_body * offset_.offset_ut();
  follow_disturbance(out.field_ut, dt_s);

  const double horizontal = out.field_ut.head<2>().norm();
  if (disturbed_ || horizontal < kLeastHorizontal) return out;
  out.usable = true;
  // Seen too far east by this angle: the estimate is turned too far clockwise by it.
  out.innovation_rad =
      wrap_pi(std::atan2(out.field_ut.x(), out.field_ut.y()) - config_.declination_rad);
  out.variance_rad2 =
      variance_across(out.field_ut, readings.world_from_body, dt_s) / (horizontal * horizontal);
  out.tilt_row = -out.field_ut.z() / (horizontal * horizontal) * out.field_ut.head<2>();
  return out;
}

void MagneticReference::learn_delay(const Readings& readings, double dt_s) {
  if (!(offset_.weight_s() > 0.0)) return;
  const Eigen::Vector3d misfit = offset_.misfit_ut(readings.field_ut, readings.world_from_body);
  const double variance = std::max(offset_.spread_ut2(), misfit.squaredNorm() / 3.0);
  delay_.add(misfit, variance, readings.slope_utps, dt_s);
}

void MagneticReference::expect(const KnownField& field) {
  known_ = field;
  known_weight_s_ = config_.known_field_s;
}

/// The field of the recent past and the one known before, each by the time that it stands for.
KnownField MagneticReference::usual(double dt_s) {
  known_weight_s_ *= std::max(0.0, 1.0 - dt_s / config_.offset.memory_s);
  const double known = known_weight_s_ / (known_weight_s_ + offset_.weight_s());
  const Eigen::Vector3d& recent = offset_.field_ut();
  return {known * known_.horizontal_ut + (1.0 - known) * recent.head<2>().norm(),
          known * known_.up_ut + (1.0 - known) * recent.z()};
}

void MagneticReference::follow_disturbance(const Eigen::Vector3d& field_ut, double dt_s) {
  const KnownField reference = usual(dt_s);
  const double seen = reference.disturbance_ut2(field_ut.head<2>().norm(), field_ut.z());
  const double strength = std::hypot(reference.horizontal_ut, reference.up_ut);
  disturbed_ = std::sqrt(2.0 * seen) > config_.gate * strength;
  disturbance_ut2_ +=
      std::min(1.0, dt_s / config_.disturbance_memory_s) * (seen - disturbance_ut2_);
}

double MagneticReference::variance_across(const Eigen::Vector3d& field_ut,
                                          const Eigen::Matrix3d& world_from_body,
                                          double dt_s) const {
  const Eigen::Vector3d level = Eigen::Vector3d(field_ut.y(), -field_ut.x(), 0.0).normalized();
  const Eigen::Vector3d across = world_from_body.transpose() * level;
  const double offset = across.dot(offset_.covariance_ut2() * across);
  const double place = std::max(config_.sigma_ut * config_.sigma_ut, disturbance_ut2_);
  // What stays alike over a while does not average out within it.
  return (place + offset) * std::max(1.0, 2.0 * config_.correlation_s / dt_s);
}

}  // namespace vpdr::pdr
