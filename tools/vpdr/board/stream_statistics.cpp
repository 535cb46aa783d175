#include "vpdr/board/stream_statistics.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::tool {

void StreamStatistics::Moments::add(double value) {
  if (count == 0.0) first = value;
  sum += value - first;
  squares += (value - first) * (value - first);
  count += 1.0;
}

double StreamStatistics::Moments::mean() const { return count > 0.0 ? first + sum / count : 0.0; }

double StreamStatistics::Moments::sigma() const {
  if (count == 0.0) return 0.0;
  return std::sqrt(std::max(0.0, squares / count - (sum / count) * (sum / count)));
}

void StreamStatistics::add(TimestampNs stamp_ns, TimestampNs arrival_ns, std::uint64_t lost_before,
                           double length) {
  if (last_ns_) {
    const double interval_s = to_seconds(stamp_ns - *last_ns_);
    interval_s_.add(interval_s);
    longest_s_ = std::max(longest_s_, interval_s);
  }
  last_ns_ = stamp_ns;
  delay_s_.add(to_seconds(arrival_ns - stamp_ns));
  length_.add(length);
  lost_ += lost_before;
  ++samples_;
}

StreamFigures StreamStatistics::take() {
  StreamFigures out;
  out.samples = samples_;
  out.rate_hz = interval_s_.mean() > 0.0 ? 1.0 / interval_s_.mean() : 0.0;
  out.stamp_jitter_ms = 1e3 * interval_s_.sigma();
  out.arrival_jitter_ms = 1e3 * delay_s_.sigma();
  out.longest_gap_ms = 1e3 * longest_s_;
  out.lost = lost_;
  out.length_mean = length_.mean();
  out.length_sigma = length_.sigma();
  const auto last = last_ns_;
  *this = {};
  last_ns_ = last;
  return out;
}

}  // namespace vpdr::tool
