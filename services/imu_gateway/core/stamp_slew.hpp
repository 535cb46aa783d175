#pragma once
// Stamps that follow a corrected clock without ever running backwards.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/time.hpp"

namespace vpdr::imu_gateway {

/// A clock fit that is corrected moves by a step; filters want the time between two samples. So a
/// correction is spread: the stamp advances by half to one and a half of what the board's clock
/// does until it has caught up. Only steps too large for that are taken at once. Pure.
class StampSlew {
 public:
  /// The stamp of a sample taken at `board_ns`, which the fit puts at `fitted_ns`. One that is not
  /// later than the sample before keeps its distance to it.
  TimestampNs stamp(TimestampNs board_ns, TimestampNs fitted_ns) {
    if (last_ && board_ns <= last_->board_ns) return last_->host_ns + board_ns - last_->board_ns;
    TimestampNs host_ns = fitted_ns;
    if (last_) {
      const TimestampNs elapsed = board_ns - last_->board_ns;
      const TimestampNs correction = fitted_ns - (last_->host_ns + elapsed);
      if (std::abs(correction) < kLargestSpread) {
        host_ns -= correction;
        host_ns += std::clamp(correction, -elapsed / 2, elapsed / 2);
      }
    }
    last_ = Pair{board_ns, host_ns};
    return host_ns;
  }
  /// The next stamp is taken as fitted.
  void restart() { last_.reset(); }

 private:
  static constexpr TimestampNs kLargestSpread = kNsPerSecond / 4;
  struct Pair {
    TimestampNs board_ns = 0;
    TimestampNs host_ns = 0;
  };
  std::optional<Pair> last_;
};

}  // namespace vpdr::imu_gateway
