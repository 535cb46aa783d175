#pragma once
// Between two steps. SI.
#include <algorithm>

namespace vpdr {

/// How far a walker has moved on since the peak of the last step, which was `length_m` long, at
/// `speed_mps`: half a step at most is taken ahead of the next one. One that is overdue does not
/// come: whoever stops stands about where the last step led.
[[nodiscard]] inline double beyond_last_step_m(double since_s, double speed_mps, double length_m) {
  if (length_m <= 0.0) return 0.0;
  const double periods = std::max(0.0, since_s * speed_mps / length_m);
  // A step is heard of half a period after its peak, and some are slow.
  const double expected = std::clamp(2.5 - periods, 0.0, 1.0);
  return expected * std::min(periods, 0.5) * length_m;
}

}  // namespace vpdr
