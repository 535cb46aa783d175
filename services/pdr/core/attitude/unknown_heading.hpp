#pragma once
#include "core/rotation.hpp"

namespace vpdr::pdr {

/// Variance of a heading of which nothing is known, rad^2: uniform over the circle.
inline constexpr double kUnknownHeading = kPi * kPi / 3.0;

}  // namespace vpdr::pdr
