#include "pdr/core/magnetic_reference.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::pdr {

namespace {
/// A field closer to vertical than this tells no heading.
constexpr double kLeastHorizontal = 2.0;
/// While disturbed the reference learns this much slower, but it does: no field is wrong for ever.
constexpr double kDisturbedSlowness = 5.0;
}  // namespace

MagneticReference::MagneticReference(const MagneticConfig& config)
    : config_(config), disturbance_ut2_(config.initial_sigma_ut * config.initial_sigma_ut) {}

MagneticReference::Judgement MagneticReference::judge(const Eigen::Vector3d& field_world_ut,
                                                      double dt_s) {
  const double horizontal = field_world_ut.head<2>().norm();
  const double vertical = field_world_ut.z();
  if (age_s_ <= 0.0) {
    horizontal_ut_ = horizontal;
    vertical_ut_ = vertical;
  }
  const double dh = horizontal - horizontal_ut_;
  const double dv = vertical - vertical_ut_;
  const double strength = std::hypot(horizontal_ut_, vertical_ut_);
  disturbed_ = std::hypot(dh, dv) > config_.gate * strength;
  learn(horizontal, vertical, dt_s);

  // Grows at once, fades slowly.
  const double seen = 0.5 * (dh * dh + dv * dv);
  const double gain = seen > disturbance_ut2_ ? std::min(1.0, dt_s / config_.correlation_s)
                                              : std::min(1.0, dt_s / config_.disturbance_memory_s);
  disturbance_ut2_ += gain * (seen - disturbance_ut2_);

  Judgement judgement;
  if (disturbed_ || horizontal < kLeastHorizontal) return judgement;
  judgement.usable = true;
  // Seen too far east by this angle: the estimate is turned too far clockwise by it.
  judgement.innovation_rad =
      wrap_pi(std::atan2(field_world_ut.x(), field_world_ut.y()) - config_.declination_rad);
  // What stays alike over a while does not average out within it.
  const double calm =
      config_.sigma_ut * config_.sigma_ut * std::max(1.0, 2.0 * config_.correlation_s / dt_s);
  const double disturbed =
      disturbance_ut2_ * std::max(1.0, 2.0 * config_.disturbance_correlation_s / dt_s);
  judgement.variance_rad2 = (calm + disturbed) / (horizontal * horizontal);
  return judgement;
}

void MagneticReference::learn(double horizontal_ut, double vertical_ut, double dt_s) {
  age_s_ += dt_s;
  const double slowness = disturbed_ ? kDisturbedSlowness : 1.0;
  const double tau = std::min(age_s_, config_.reference_time_constant_s) * slowness;
  const double gain = std::min(1.0, dt_s / tau);
  horizontal_ut_ += gain * (horizontal_ut - horizontal_ut_);
  vertical_ut_ += gain * (vertical_ut - vertical_ut_);
}

}  // namespace vpdr::pdr
