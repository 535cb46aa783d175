#include "run_export/imu_times.hpp"

#include <algorithm>

namespace vpdr::run_export {

void ImuTimes::add(TimestampNs stamp_ns, TimestampNs publish_time_ns) {
  entries_.push_back({stamp_ns, publish_time_ns, false});
}

void ImuTimes::sort() {
  std::stable_sort(entries_.begin(), entries_.end(),
                   [](const Entry& a, const Entry& b) { return a.stamp_ns < b.stamp_ns; });
  const auto repeated =
      std::unique(entries_.begin(), entries_.end(),
                  [](const Entry& a, const Entry& b) { return a.stamp_ns == b.stamp_ns; });
  entries_.erase(repeated, entries_.end());
}

std::optional<TimestampNs> ImuTimes::answer(TimestampNs stamp_ns) {
  const auto found =
      std::lower_bound(entries_.begin(), entries_.end(), stamp_ns,
                       [](const Entry& entry, TimestampNs ns) { return entry.stamp_ns < ns; });
  if (found == entries_.end() || found->stamp_ns != stamp_ns || found->answered) {
    return std::nullopt;
  }
  found->answered = true;
  return found->publish_time_ns;
}

std::uint64_t ImuTimes::unanswered() const {
  const auto answered = [](const Entry& entry) { return entry.answered; };
  const auto first = std::find_if(entries_.begin(), entries_.end(), answered);
  return static_cast<std::uint64_t>(
      std::count_if(first, entries_.end(), [](const Entry& entry) { return !entry.answered; }));
}

double ImuTimes::duration_s() const {
  return entries_.empty() ? 0.0 : to_seconds(entries_.back().stamp_ns - entries_.front().stamp_ns);
}

}  // namespace vpdr::run_export
