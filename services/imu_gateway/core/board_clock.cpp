#include "imu_gateway/core/board_clock.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::imu_gateway {
namespace {

/// Share of a new arrival in the mean delay: a few hundred samples.
constexpr double kJitterGain = 0.005;
/// Crystals are off by less than a tenth of a millisecond in this time, first arrivals by more.
constexpr double kFirstSpan_s = 1.0;
/// Samples after which a single early one is doubted.
constexpr std::size_t kEstablished = 100;

}  // namespace

BoardClock::BoardClock(const BoardClockOptions& options)
    : options_(options),
      envelope_({.window = options.window_s,
                 .min_slope = -options.max_skew,
                 .max_slope = options.max_skew,
                 .first_span = kFirstSpan_s,
                 .trust_span = options.window_s / 4.0}) {}

void BoardClock::restart() {
  begun_ = false;
  lone_offset_ns_.reset();
}

double BoardClock::x_of(TimestampNs board_ns) const {
  return to_seconds(board_ns - origin_board_ns_);
}

TimestampNs BoardClock::fitted(TimestampNs board_ns) const {
  return origin_arrival_ns_ + (board_ns - origin_board_ns_) +
         to_ns(envelope_.line().at(x_of(board_ns)));
}

TimestampNs BoardClock::begin(TimestampNs raw_ns, TimestampNs arrival_ns) {
  // The crystal stays the same over a reset: its skew holds until the new samples tell their own.
  envelope_.restart(envelope_.known_slope());
  slew_.restart();
  begun_ = true;
  wrapped_ns_ = 0;
  origin_board_ns_ = last_board_ns_ = raw_ns;
  origin_arrival_ns_ = arrival_ns;
  last_was_early_ = false;
  lone_offset_ns_.reset();
  late_since_ns_.reset();
  envelope_.add(0.0, 0.0);
  return slew_.stamp(raw_ns, arrival_ns);
}

TimestampNs BoardClock::unwrapped(TimestampNs raw_ns, TimestampNs wraps_at_ns,
                                  TimestampNs arrival_ns) {
  const TimestampNs board_ns = raw_ns + wrapped_ns_;
  const bool ran_over = wraps_at_ns > 0 && last_board_ns_ - wrapped_ns_ < wraps_at_ns &&
                        board_ns < last_board_ns_ - wraps_at_ns / 2;
  if (!ran_over) return board_ns;
  const double delay_s = to_seconds(arrival_ns - fitted(board_ns + wraps_at_ns));
  if (std::abs(delay_s) > options_.jump_s) return board_ns;
  wrapped_ns_ += wraps_at_ns;
  ++health_.wraps;
  return board_ns + wraps_at_ns;
}

std::optional<TimestampNs> BoardClock::jumped(TimestampNs raw_ns, TimestampNs arrival_ns) {
  const TimestampNs offset_ns = arrival_ns - raw_ns;
  if (lone_offset_ns_ && std::abs(to_seconds(offset_ns - *lone_offset_ns_)) < options_.jump_s) {
    ++health_.resets;
    return begin(raw_ns, arrival_ns);
  }
  lone_offset_ns_ = offset_ns;
  ++health_.outliers;
  return std::nullopt;
}

bool BoardClock::is_late_for_good(double delay_s, TimestampNs arrival_ns) {
  if (delay_s < options_.late_s) {
    late_since_ns_.reset();
    return false;
  }
  if (!late_since_ns_) late_since_ns_ = arrival_ns;
  return to_seconds(arrival_ns - *late_since_ns_) > options_.late_for_s;
}

void BoardClock::learn(TimestampNs board_ns, TimestampNs arrival_ns, double delay_s) {
  const bool early = delay_s < -options_.doubtful_s && envelope_.count() > kEstablished;
  if (!early || last_was_early_) {
    envelope_.add(x_of(board_ns),
                  to_seconds((arrival_ns - origin_arrival_ns_) - (board_ns - origin_board_ns_)));
  }
  last_was_early_ = early;
  last_board_ns_ = board_ns;
  const double delay_ms = 1e3 * std::max(delay_s, 0.0);
  health_.skew_ppm = 1e6 * envelope_.line().slope;
  health_.jitter_ms += kJitterGain * (delay_ms - health_.jitter_ms);
  health_.worst_delay_ms = std::max(health_.worst_delay_ms, delay_ms);
}

std::optional<TimestampNs> BoardClock::host_stamp(TimestampNs raw_ns, TimestampNs wraps_at_ns,
                                                  TimestampNs arrival_ns) {
  if (!begun_) return begin(raw_ns, arrival_ns);
  const TimestampNs board_ns = unwrapped(raw_ns, wraps_at_ns, arrival_ns);
  const double delay_s = to_seconds(arrival_ns - fitted(board_ns));
  const double step_s = to_seconds(board_ns - last_board_ns_);
  if (delay_s < -options_.jump_s || step_s < -options_.jump_s) return jumped(raw_ns, arrival_ns);
  lone_offset_ns_.reset();
  if (is_late_for_good(delay_s, arrival_ns)) {
    ++health_.resets;
    return begin(raw_ns, arrival_ns);
  }
  if (step_s > 0.0) learn(board_ns, arrival_ns, delay_s);
  return slew_.stamp(board_ns, fitted(board_ns));
}

}  // namespace vpdr::imu_gateway
