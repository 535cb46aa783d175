#pragma once
// The rate of a stream of samples and the holes in it, from its stamps alone. Pure; allocates
// nothing.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "core/time.hpp"

namespace vpdr::imu_gateway {

/// The period is the median of the last 31 steps, looked at anew every 16: neither holes nor
/// jitter move it, and a changed rate is followed.
class StreamWatch {
 public:
  /// Stamps in rising order.
  void see(TimestampNs stamp_ns) {
    const TimestampNs step_ns = last_ns_ ? stamp_ns - *last_ns_ : 0;
    last_ns_ = stamp_ns;
    if (step_ns <= 0) return;
    const double periods = static_cast<double>(step_ns) / static_cast<double>(period_ns_);
    if (period_ns_ > 0 && periods > kHole) {
      ++gaps_;
      missing_ += static_cast<std::uint64_t>(std::llround(periods)) - 1;
    }
    steps_[next_++ % steps_.size()] = step_ns;
    if (next_ >= steps_.size() && next_ % 16 == 0) take_median();
  }
  /// 0: not known yet.
  [[nodiscard]] double rate_hz() const { return period_ns_ > 0 ? 1e9 / period_ns_ : 0.0; }
  [[nodiscard]] std::uint64_t gaps() const { return gaps_; }
  [[nodiscard]] std::uint64_t missing() const { return missing_; }

 private:
  static constexpr double kHole = 1.6;
  void take_median() {
    auto sorted = steps_;
    const auto middle = sorted.begin() + sorted.size() / 2;
    std::nth_element(sorted.begin(), middle, sorted.end());
    period_ns_ = *middle;
  }

  std::optional<TimestampNs> last_ns_;
  std::array<TimestampNs, 31> steps_{};
  std::size_t next_ = 0;
  TimestampNs period_ns_ = 0;
  std::uint64_t gaps_ = 0;
  std::uint64_t missing_ = 0;
};

}  // namespace vpdr::imu_gateway
