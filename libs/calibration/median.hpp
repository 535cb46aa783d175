#pragma once
// Middle values.
#include <algorithm>
#include <vector>

namespace vpdr::calibration {

/// Standard deviation of a normal distribution whose median absolute value is 1.
inline constexpr double kDeviationPerMedian = 1.4826;

/// The middle value (the upper one of two); 0 of none.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace vpdr::calibration
