#pragma once
// Between two steps, and after the last one. SI.
//
// Whoever stops breaks within two steps that bounce almost as much as the others: over 39 halts of
// 27 recorded walks the body comes to rest 0.6 of the last step (+- 0.4) behind where the steps
// lead, by its own acceleration between walking speed and rest.
#include <algorithm>

namespace vpdr {

/// Of the last step's length, by which its walker stands behind where it led, and what that varies.
inline constexpr double kHaltShare = 0.6;
inline constexpr double kHaltSigma = 0.4;

/// The next step is overdue for good: one is heard of half a period after its peak, and some are
/// slow.
[[nodiscard]] inline bool has_halted(double since_s, double period_s) {
  return since_s > 2.5 * period_s;
}

/// How far a walker has moved on `since_s` after the peak of the last step, which was `length_m`
/// long and took `period_s`: half a step at most is taken ahead of the next one; where that does
/// not come, the walker stands short of where the last one led.
[[nodiscard]] inline double beyond_last_step_m(double since_s, double period_s, double length_m) {
  if (period_s <= 0.0) return 0.0;
  const double periods = std::max(0.0, since_s / period_s);
  const double expected = std::clamp(2.5 - periods, 0.0, 1.0);
  return (expected * std::min(periods, 0.5) - (1.0 - expected) * kHaltShare) * length_m;
}

}  // namespace vpdr
