#pragma once
// From a board's clock to the host's. Arrivals jitter by milliseconds and now and then by a tenth
// of a second, but nothing arrives before it was measured: the line under (board time, arrival) is
// the board's clock, its slope the skew. What cannot be known is the least delay, that of the
// quickest message: it stays in the stamps. Pure; belongs to one thread; allocates nothing once
// under way.
#include <cstdint>
#include <optional>

#include "imu_gateway/core/lower_envelope.hpp"
#include "imu_gateway/core/stamp_slew.hpp"

namespace vpdr::imu_gateway {

/// What a clock fit knows of itself.
struct ClockHealth {
  double skew_ppm = 0.0;        ///< how much the board's second is too short, in millionths
  double jitter_ms = 0.0;       ///< mean delay of arrivals behind the fit, over the last seconds
  double worst_delay_ms = 0.0;  ///< the largest one since the start
  std::uint64_t resets = 0;     ///< the board's clock began anew or jumped
  std::uint64_t wraps = 0;      ///< its counter ran over
  std::uint64_t outliers = 0;   ///< stamps that no other bore out: their samples are refused
};

struct BoardClockOptions {
  double window_s = 20.0;     ///< looked back on at least; twice as much at most
  double max_skew = 0.03;     ///< the worst RC oscillators are off by so much
  double jump_s = 0.5;        ///< a stamp further from the fit is a reset or an outlier
  double late_s = 0.1;        ///< a board that is later than this ...
  double late_for_s = 0.6;    ///< ... with every sample for so long has another clock now
  double doubtful_s = 0.002;  ///< a sample earlier than the fit by this needs a second one
};

class BoardClock {
 public:
  explicit BoardClock(const BoardClockOptions& options = {});

  /// The host's time of a measurement at `board_ns` of the board's clock, which starts again at
  /// `wraps_at_ns` (0: never), seen at `arrival_ns`. None for a stamp that stands alone.
  std::optional<TimestampNs> host_stamp(TimestampNs board_ns, TimestampNs wraps_at_ns,
                                        TimestampNs arrival_ns);
  /// The board may be another one now; the next stamp begins anew.
  void restart();
  [[nodiscard]] const ClockHealth& health() const { return health_; }

 private:
  [[nodiscard]] double x_of(TimestampNs board_ns) const;
  [[nodiscard]] TimestampNs fitted(TimestampNs board_ns) const;
  TimestampNs unwrapped(TimestampNs raw_ns, TimestampNs wraps_at_ns, TimestampNs arrival_ns);
  TimestampNs begin(TimestampNs raw_ns, TimestampNs arrival_ns);
  std::optional<TimestampNs> jumped(TimestampNs raw_ns, TimestampNs arrival_ns);
  bool is_late_for_good(double delay_s, TimestampNs arrival_ns);
  void learn(TimestampNs board_ns, TimestampNs arrival_ns, double delay_s);

  BoardClockOptions options_;
  LowerEnvelope envelope_;
  StampSlew slew_;
  ClockHealth health_;
  bool begun_ = false;
  TimestampNs origin_board_ns_ = 0;
  TimestampNs origin_arrival_ns_ = 0;
  TimestampNs wrapped_ns_ = 0;     ///< what the run-over counter has lost so far
  TimestampNs last_board_ns_ = 0;  ///< unwrapped
  bool last_was_early_ = false;
  std::optional<TimestampNs> lone_offset_ns_;  ///< arrival minus raw stamp of the last outlier
  std::optional<TimestampNs> late_since_ns_;
};

}  // namespace vpdr::imu_gateway
