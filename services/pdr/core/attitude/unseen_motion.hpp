#pragma once
// What a walker's device did between two samples that are far apart. Rate and force are taken to
// change evenly from one to the other, but in a tenth of a second a hand or a leg swings forth and
// back. Variances that a silence of `dt_s` seconds adds; none at 20 Hz and above. SI.
#include <algorithm>

#include "core/square.hpp"

namespace vpdr::pdr {

/// A shorter silence hides nothing, s.
inline constexpr double kSeen_s = 0.06;
/// How fast a carried device turns and how hard it is pushed, each axis, within a step.
inline constexpr double kUnseenRate_radps = 1.0;
/// The same about the vertical, where swings end where they began.
inline constexpr double kUnseenYawRate_radps = 0.2;
inline constexpr double kUnseenForce_mps2 = 6.0;

[[nodiscard]] inline double unseen_turn_rad2(double dt_s, double rate_radps = kUnseenRate_radps) {
  return square(rate_radps * std::max(0.0, dt_s - kSeen_s));
}

[[nodiscard]] inline double unseen_velocity_m2ps2(double dt_s) {
  return square(kUnseenForce_mps2 * std::max(0.0, dt_s - kSeen_s));
}

}  // namespace vpdr::pdr
