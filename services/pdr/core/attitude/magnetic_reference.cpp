#include "pdr/core/attitude/magnetic_reference.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "pdr/core/attitude/uncalibrated.hpp"

namespace vpdr::pdr {

namespace {
/// A field closer to vertical than this tells no heading, uT.
constexpr double kLeastHorizontal = 2.0;
/// Share of its square that a changed offset leaves in the field's two known directions at least,
/// and the time over which a heading remembers fields, s.
constexpr double kSameField = 0.02;
constexpr double kFollowed_s = 60.0;
}  // namespace

MagneticReference::MagneticReference(const MagneticConfig& config)
    : config_(config),
      offset_(config.offset),
      delay_(config.delay),
      disturbance_ut2_(config.initial_sigma_ut * config.initial_sigma_ut),
      trusted_information_(offset_.covariance_ut2().inverse()) {}

MagneticReference::Judgement MagneticReference::judge(const Readings& readings, double dt_s) {
  learn_delay(readings, dt_s);
  offset_.add(readings.field_ut, readings.world_from_body, dt_s);
  Judgement out;
  out.field_ut = readings.field_ut - readings.world_from_body * offset_.offset_ut();
  follow_disturbance(out.field_ut, dt_s);

  const double horizontal = out.field_ut.head<2>().norm();
  if (!disturbed_) out.stale_rad2 = find_stale(readings.world_from_body);
  if (disturbed_ || horizontal < kLeastHorizontal) return out;
  out.usable = true;
  follow(out.field_ut, dt_s);
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

/// An offset that moved within what was known of it is no news: headings are as unsure as that. Nor
/// is one that came later than they: the field without it is the one that they followed.
double MagneticReference::find_stale(const Eigen::Matrix3d& world_from_body) {
  const Eigen::Vector3d moved = offset_.offset_ut() - trusted_offset_;
  if (moved.dot(trusted_information_ * moved) < kSurprise) return 0.0;
  trusted_offset_ = offset_.offset_ut();
  trusted_information_ = offset_.covariance_ut2().inverse();
  const Eigen::Vector3d& field = offset_.field_ut();
  const double horizontal = std::max(field.head<2>().norm(), kLeastHorizontal);
  const double differing = followed_.disturbance_ut2(horizontal, field.z());
  followed_weight_s_ = 0.0;
  if (differing < kSameField * moved.squaredNorm()) return 0.0;
  return (world_from_body * moved).head<2>().squaredNorm() / (horizontal * horizontal);
}

void MagneticReference::follow(const Eigen::Vector3d& field_ut, double dt_s) {
  const double least = config_.sigma_ut * config_.sigma_ut;
  const double weight_s = dt_s * least / std::max(least, disturbance_ut2_);
  followed_weight_s_ = std::min(followed_weight_s_ + weight_s, kFollowed_s);
  const double gain = weight_s / followed_weight_s_;
  followed_.horizontal_ut += gain * (field_ut.head<2>().norm() - followed_.horizontal_ut);
  followed_.up_ut += gain * (field_ut.z() - followed_.up_ut);
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
