#pragma once
// Counts the silences of a topic: one for each deadline that passes without a sample, from the
// first sample on, as DDS counts them. Fast DDS's own DEADLINE stops and starts a timer of another
// thread with each sample at both ends, a third of the cost of a sample; here a clock is read. Not
// thread-safe.
#include <chrono>
#include <cstdint>
#include <optional>

namespace vpdr::dds::detail {

class DeadlineWatch {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// 0: no deadline, nothing is counted.
  explicit DeadlineWatch(double deadline_s)
      : deadline_(
            std::chrono::duration_cast<Time::duration>(std::chrono::duration<double>(deadline_s))) {
  }

  /// A sample has come.
  void see(Time now) {
    if (deadline_ == Time::duration::zero()) return;
    missed_ = missed(now);
    last_ = now;
  }
  /// Deadlines missed until now.
  [[nodiscard]] std::uint64_t missed(Time now) const {
    return missed_ + (last_ ? static_cast<std::uint64_t>((now - *last_) / deadline_) : 0U);
  }
  /// When the next one is missed, unless a sample comes.
  [[nodiscard]] std::optional<Time> next(Time now) const {
    if (!last_) return std::nullopt;
    return *last_ + ((now - *last_) / deadline_ + 1) * deadline_;
  }

 private:
  Time::duration deadline_;
  std::optional<Time> last_;
  std::uint64_t missed_ = 0;
};

}  // namespace vpdr::dds::detail
