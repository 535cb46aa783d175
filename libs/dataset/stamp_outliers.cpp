#include "dataset/stamp_outliers.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace vpdr::dataset {
namespace {

/// So many rows after the one in question bear witness; fewer than half of them may be wrong too.
constexpr std::size_t kWitnesses = 8;
constexpr std::uint64_t kAlways = std::numeric_limits<std::uint64_t>::max();

/// How far `to` lies after `from`, over the whole range of stamps; 0 where it does not.
std::uint64_t ahead(TimestampNs to, TimestampNs from) {
  return to > from ? static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from) : 0;
}

class StampJudge {
 public:
  StampJudge(std::span<const TimestampNs> stamps, RowsOf rows) : stamps_(stamps), rows_(rows) {
    // Truth may have a row every ten seconds: what is far depends on the table.
    constexpr std::uint64_t kIntervals = 1000;
    const std::uint64_t interval = usual_interval();
    far_ = interval > kAlways / kIntervals ? kAlways : std::max(far_, kIntervals * interval);
  }

  bool is_outlier(std::size_t row) {
    const TimestampNs stamp = stamps_[row];
    const bool outlier = last_ ? leaps_ahead(row) : lies_apart(row);
    if (!outlier && (!last_ || stamp > *last_)) last_ = stamp;
    return outlier;
  }

 private:
  [[nodiscard]] std::uint64_t usual_interval() const {
    std::vector<std::uint64_t> intervals;
    for (std::size_t i = 1; i < stamps_.size(); ++i) {
      if (stamps_[i] > stamps_[i - 1]) intervals.push_back(ahead(stamps_[i], stamps_[i - 1]));
    }
    if (intervals.empty()) return 0;
    const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>((intervals.size() - 1) / 2);
    std::nth_element(intervals.begin(), middle, intervals.end());
    return *middle;
  }

  [[nodiscard]] std::span<const TimestampNs> witnesses(std::size_t row) const {
    return stamps_.subspan(row + 1, std::min(kWitnesses, stamps_.size() - row - 1));
  }

  [[nodiscard]] bool is_far(TimestampNs a, TimestampNs b) const {
    return ahead(a, b) > far_ || ahead(b, a) > far_;
  }

  /// Ahead of the last good row, and the next ones are not. After a last sample there are none: a
  /// long way counts.
  [[nodiscard]] bool leaps_ahead(std::size_t row) const {
    constexpr std::uint64_t kShare = 60;
    const std::uint64_t leap = ahead(stamps_[row], *last_);
    const auto next = witnesses(row);
    if (next.empty()) return rows_ == RowsOf::kSamples && leap > far_;
    const auto behind = std::count_if(next.begin(), next.end(),
                                      [&](TimestampNs stamp) { return stamp <= stamps_[row]; });
    return leap > far_ / kShare && 2 * static_cast<std::size_t>(behind) > next.size();
  }

  /// At the begin: far from most of the next rows, which agree, and the next does not follow on.
  [[nodiscard]] bool lies_apart(std::size_t row) const {
    const auto next = witnesses(row);
    if (next.size() < 2) return false;
    const TimestampNs stamp = stamps_[row];
    if (next[0] > stamp && !is_far(next[0], stamp)) return false;
    std::vector<TimestampNs> sorted(next.begin(), next.end());
    std::sort(sorted.begin(), sorted.end());
    const TimestampNs middle = sorted[sorted.size() / 2];
    if (rows_ == RowsOf::kEvents && stamp < middle) return false;
    const auto agree = std::count_if(next.begin(), next.end(),
                                     [&](TimestampNs other) { return !is_far(other, middle); });
    return is_far(stamp, middle) && 2 * static_cast<std::size_t>(agree) > next.size();
  }

  std::span<const TimestampNs> stamps_;
  RowsOf rows_;
  std::uint64_t far_ = 60 * static_cast<std::uint64_t>(kNsPerSecond);
  std::optional<TimestampNs> last_;
};

}  // namespace

std::vector<bool> stamp_outliers(std::span<const TimestampNs> stamps, RowsOf rows) {
  StampJudge judge(stamps, rows);
  std::vector<bool> outliers(stamps.size());
  for (std::size_t row = 0; row < stamps.size(); ++row) outliers[row] = judge.is_outlier(row);
  return outliers;
}

}  // namespace vpdr::dataset
