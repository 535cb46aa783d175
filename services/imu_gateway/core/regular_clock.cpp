#include "imu_gateway/core/regular_clock.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::imu_gateway {
namespace {

/// Samples after which the period is known well enough to tell a missing one.
constexpr std::size_t kEstablished = 50;
/// Later than this share of a period is late.
constexpr double kLate = 0.75;

}  // namespace

RegularClock::RegularClock(const RegularClockOptions& options)
    : options_(options),
      envelope_({.window = options.window_samples,
                 .min_slope = options.shortest_period_s,
                 .max_slope = options.longest_period_s,
                 .trust_span = options.window_samples / 20.0}) {}

void RegularClock::restart() {
  begun_ = false;
  envelope_.restart(envelope_.known_slope());
  slew_.restart();
}

bool RegularClock::is_late_for_good(double delay_s, double arrival_s) {
  if (envelope_.count() < kEstablished || delay_s < kLate * envelope_.line().slope) {
    late_in_a_row_ = 0;
    return false;
  }
  if (late_in_a_row_++ == 0) {
    late_since_s_ = arrival_s;
    least_delay_s_ = delay_s;
  }
  least_delay_s_ = std::min(least_delay_s_, delay_s);
  return late_in_a_row_ >= options_.late_samples &&
         arrival_s - late_since_s_ >= options_.late_for_s;
}

void RegularClock::skip_missing(double arrival_s, double delay_s) {
  const double period_s = envelope_.line().slope;
  const double missing = std::max(std::round(least_delay_s_ / period_s), 1.0);
  number_ += missing;
  regular_ns_ += to_ns(missing * period_s);
  ++health_.gaps;
  health_.missing += static_cast<std::uint64_t>(missing);
  // Late again so soon: it is the period that has changed.
  envelope_.restart(envelope_.slope_is_trusted() ? envelope_.known_slope() : std::nullopt);
  slew_.restart();
  late_in_a_row_ = 0;
  // The quickest of the late ones tells where the line is now.
  envelope_.add(number_, arrival_s - delay_s + least_delay_s_);
}

TimestampNs RegularClock::host_stamp(TimestampNs arrival_ns) {
  const bool first = !begun_;
  if (first) {
    begun_ = true;
    origin_ns_ = arrival_ns;
    number_ = 0.0;
    late_in_a_row_ = 0;
  } else {
    number_ += 1.0;
  }
  const double arrival_s = to_seconds(arrival_ns - origin_ns_);
  const double delay_s = arrival_s - envelope_.line().at(number_);
  if (is_late_for_good(delay_s, arrival_s)) {
    skip_missing(arrival_s, delay_s);
  } else {
    envelope_.add(number_, arrival_s);
  }
  health_.period_s = envelope_.line().slope;
  if (!first) regular_ns_ += to_ns(health_.period_s);
  const TimestampNs fitted_ns = origin_ns_ + to_ns(envelope_.line().at(number_));
  const TimestampNs stamp_ns = slew_.stamp(regular_ns_, fitted_ns);
  // A step over missing samples may begin behind stamps that were still catching up.
  const TimestampNs earliest_ns = first ? stamp_ns : last_stamp_ns_ + to_ns(health_.period_s / 2.0);
  last_stamp_ns_ = std::max(stamp_ns, earliest_ns);
  return last_stamp_ns_;
}

}  // namespace vpdr::imu_gateway
