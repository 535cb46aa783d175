#pragma once
// When each inertial sample was sent, by its sensor stamp.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/time.hpp"

namespace vpdr::run_export {

/// 24 bytes for each sample. Not thread-safe.
class ImuTimes {
 public:
  /// In any order; of two with one stamp the first counts.
  void add(TimestampNs stamp_ns, TimestampNs publish_time_ns);
  /// Once, between the last add() and the first answer().
  void sort();

  /// When the sample of that stamp was sent; marks it as answered. Nothing where there is none or
  /// it was answered before.
  std::optional<TimestampNs> answer(TimestampNs stamp_ns);

  /// Samples from the first answered one on that were never answered.
  [[nodiscard]] std::uint64_t unanswered() const;
  [[nodiscard]] double duration_s() const;

 private:
  struct Entry {
    TimestampNs stamp_ns = 0;
    TimestampNs publish_time_ns = 0;
    bool answered = false;
  };
  std::vector<Entry> entries_;
};

}  // namespace vpdr::run_export
