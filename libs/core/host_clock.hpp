#pragma once
// The host's clock, for whoever stamps what comes in. Algorithms do not read it.
#include <chrono>

#include "core/time.hpp"

namespace vpdr {

/// Nanoseconds since 1970.
inline TimestampNs host_now_ns() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace vpdr
