#pragma once
// The earth's magnetic field as the board's calibration measured it, away from steel: microtesla.
// What differs from it is a disturbance, also at the start, when nothing else is known yet.
#include <algorithm>
#include <cmath>

namespace vpdr::pdr {

struct KnownField {
  double horizontal_ut = 0.0;
  double up_ut = 0.0;  ///< negative on the northern half

  /// Variance of one direction of a disturbance, by the two directions in which it can be seen:
  /// it has no preferred one.
  [[nodiscard]] double disturbance_ut2(double horizontal, double up) const {
    const double across = horizontal - horizontal_ut;
    const double along = up - up_ut;
    return 0.5 * (across * across + along * along);
  }
};

/// What the earth's field, which is 22 to 67 uT strong anywhere, leaves of a reading at least: a
/// variance, none of a reading that it may be alone.
[[nodiscard]] inline double impossible_ut2(double strength_ut) {
  const double beyond = std::max({0.0, strength_ut - 67.0, 22.0 - strength_ut});
  return beyond * beyond;
}

/// From the field's strength and its dip below the horizon, rad.
inline KnownField known_field(double strength_ut, double dip_rad) {
  return {strength_ut * std::cos(dip_rad), -strength_ut * std::sin(dip_rad)};
}

}  // namespace vpdr::pdr
