#pragma once
// What the recorder counts of each topic. Nothing here is thread-safe.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/time.hpp"

namespace vpdr::recorder {

/// Counters of one topic since the start. Times: recorder's host clock, at reception.
struct TopicStatistics {
  std::uint64_t received = 0;  ///< samples that reached the recorder
  std::uint64_t lost = 0;      ///< samples missing between those that did
  std::uint64_t before = 0;    ///< samples sent before the recorder was there
  std::uint64_t written = 0;   ///< samples that are in the file
  std::uint64_t bytes = 0;     ///< of the samples received
  std::optional<TimestampNs> first_ns;
  std::optional<TimestampNs> last_ns;

  /// One sample arrived; `lost_before` are missing between it and the one before of its sender.
  void take(TimestampNs time_ns, std::size_t sample_bytes, std::uint64_t lost_before);
  /// Samples a second between the first and the last; 0 for fewer than two.
  [[nodiscard]] double rate_hz() const;

  /// Adds the counters; the span covers both.
  TopicStatistics& operator+=(const TopicStatistics& other);
};

/// How much a growing count grew over the last ten reports.
class RecentGrowth {
 public:
  /// Takes the count of one more report; gives the growth since the report ten before.
  std::uint64_t update(std::uint64_t count);

 private:
  static constexpr std::size_t kReports = 10;
  std::array<std::uint64_t, kReports> counts_{};
  std::size_t next_ = 0;
};

}  // namespace vpdr::recorder
