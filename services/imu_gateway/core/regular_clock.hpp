#pragma once
// Stamps for a board without a clock. Its samples are taken at a regular rate, whatever the
// arrivals look like: the line under (number of the sample, arrival) has the period for its slope.
// Where samples are missing every later one is late by whole periods: that is noticed and counted
// within a second, and the stamps go on in step. Pure; belongs to one thread.
#include <cstdint>
#include <optional>

#include "imu_gateway/core/lower_envelope.hpp"
#include "imu_gateway/core/stamp_slew.hpp"

namespace vpdr::imu_gateway {

struct RegularClockOptions {
  double window_samples = 4000.0;  ///< looked back on at least; twice as many at most
  double shortest_period_s = 1e-4;
  double longest_period_s = 2.0;
  double late_for_s = 1.0;  ///< every sample of so long a time is late: some are missing
  int late_samples = 8;     ///< at least
};

struct RegularClockHealth {
  double period_s = 0.0;
  std::uint64_t gaps = 0;     ///< times that samples were missing
  std::uint64_t missing = 0;  ///< how many, by the lateness of those after them
};

class RegularClock {
 public:
  explicit RegularClock(const RegularClockOptions& options = {});

  /// The host's time of the next measurement, seen at `arrival_ns`.
  TimestampNs host_stamp(TimestampNs arrival_ns);
  void restart();
  [[nodiscard]] const RegularClockHealth& health() const { return health_; }

 private:
  bool is_late_for_good(double delay_s, double arrival_s);
  void skip_missing(double arrival_s, double delay_s);

  RegularClockOptions options_;
  LowerEnvelope envelope_;  ///< arrival in seconds over the number of the sample
  StampSlew slew_;
  RegularClockHealth health_;
  bool begun_ = false;
  TimestampNs origin_ns_ = 0;
  double number_ = 0.0;         ///< of the sample, missing ones counted
  TimestampNs regular_ns_ = 0;  ///< sum of the periods as they were known
  TimestampNs last_stamp_ns_ = 0;
  int late_in_a_row_ = 0;
  double late_since_s_ = 0.0;
  double least_delay_s_ = 0.0;  ///< since then
};

}  // namespace vpdr::imu_gateway
