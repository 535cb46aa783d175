#pragma once
// Rate, jitter and loss of a stream of samples, and the mean length of what it measures.
#include <cstdint>
#include <optional>

#include "core/time.hpp"

namespace vpdr::tool {

/// What one period of a stream was like.
struct StreamFigures {
  std::uint64_t samples = 0;
  double rate_hz = 0.0;
  double stamp_jitter_ms = 0.0;    ///< deviation of the intervals between stamps
  double arrival_jitter_ms = 0.0;  ///< deviation of arrival less stamp
  double longest_gap_ms = 0.0;     ///< between two stamps
  std::uint64_t lost = 0;          ///< on the way from the gateway
  double length_mean = 0.0;
  double length_sigma = 0.0;
};

/// Sums over one period. Not thread-safe.
class StreamStatistics {
 public:
  /// `lost_before`: samples that are missing between the one before and this one.
  void add(TimestampNs stamp_ns, TimestampNs arrival_ns, std::uint64_t lost_before, double length);
  /// The figures since the last call; the next period begins.
  StreamFigures take();

 private:
  /// Mean and deviation of numbers, about the first of them.
  struct Moments {
    double first = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    void add(double value);
    [[nodiscard]] double mean() const;
    [[nodiscard]] double sigma() const;
  };
  std::optional<TimestampNs> last_ns_;
  std::uint64_t samples_ = 0;
  std::uint64_t lost_ = 0;
  double longest_s_ = 0.0;
  Moments interval_s_;
  Moments delay_s_;
  Moments length_;
};

}  // namespace vpdr::tool
