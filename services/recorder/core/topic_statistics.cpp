#include "recorder/core/topic_statistics.hpp"

#include <algorithm>
#include <utility>

namespace vpdr::recorder {

void TopicStatistics::take(TimestampNs time_ns, std::size_t sample_bytes,
                           std::uint64_t lost_before) {
  ++received;
  lost += lost_before;
  bytes += sample_bytes;
  first_ns = std::min(first_ns.value_or(time_ns), time_ns);
  last_ns = std::max(last_ns.value_or(time_ns), time_ns);
}

double TopicStatistics::rate_hz() const {
  if (received < 2 || *last_ns == *first_ns) return 0.0;
  return static_cast<double>(received - 1) / to_seconds(*last_ns - *first_ns);
}

TopicStatistics& TopicStatistics::operator+=(const TopicStatistics& other) {
  received += other.received;
  lost += other.lost;
  before += other.before;
  written += other.written;
  bytes += other.bytes;
  if (other.first_ns) first_ns = std::min(first_ns.value_or(*other.first_ns), *other.first_ns);
  if (other.last_ns) last_ns = std::max(last_ns.value_or(*other.last_ns), *other.last_ns);
  return *this;
}

std::uint64_t RecentGrowth::update(std::uint64_t count) {
  const std::uint64_t before = std::exchange(counts_[next_], count);
  next_ = (next_ + 1) % kReports;
  return count - std::min(before, count);
}

}  // namespace vpdr::recorder
