#pragma once
// Time is int64 nanoseconds of the sensor's own clock; filters never read another one.
#include <cstdint>

namespace vpdr {

/// Nanoseconds of the sensor clock (or of the host clock it is mapped to).
using TimestampNs = std::int64_t;

inline constexpr TimestampNs kNsPerSecond = 1'000'000'000;

/// Duration in seconds of `ns` nanoseconds.
constexpr double to_seconds(TimestampNs ns) { return static_cast<double>(ns) * 1e-9; }

/// Nearest number of nanoseconds of `s` seconds.
constexpr TimestampNs to_ns(double s) {
  return static_cast<TimestampNs>(s * 1e9 + (s < 0.0 ? -0.5 : 0.5));
}

}  // namespace vpdr
