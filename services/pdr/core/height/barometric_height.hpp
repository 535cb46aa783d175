#pragma once
// Height above the start from a barometer: readings of any rate are averaged over half a second,
// turned into metres and given to a VerticalFilter; a FloorTracker makes floors of its heights.
//
//   BarometricHeight height(HeightConfig{});
//   height.add(pressure_sample, walking, variance_so_far);
//   if (height.known()) use(height.height_m(now), height.variance_m2(now));
//
// Nothing is known before the first reading. Samples have passed a SampleGate. SI. Not
// thread-safe; allocates nothing.
#include <optional>

#include "core/samples.hpp"
#include "pdr/core/height/floor_tracker.hpp"
#include "pdr/core/height/vertical_filter.hpp"

namespace vpdr::pdr {

struct HeightConfig {
  double temperature_k = 293.15;  ///< K, of the air at the start; (200, 350)
  double period_s = 0.5;          ///< s, of one mean pressure; (0.05, 5)
  double noise_m = 0.02;          ///< m, of a mean, at least; more is learned; (0, 10)
  double stray_mps = 0.1;         ///< m/s, what a silent barometer may miss; (0, 10)
  VerticalConfig vertical;
  FloorConfig floors;
};

/// Height of the pressure p above that of p0: the international barometric formula (ICAO Doc
/// 7488), h = T0 / L (1 - (p / p0)^(R L / g)), with the temperature T0 where the pressure is p0.
[[nodiscard]] double barometric_height_m(double pressure_pa, double reference_pa,
                                         double temperature_k);

class BarometricHeight {
 public:
  explicit BarometricHeight(const HeightConfig& config = {})
      : config_(config), filter_(config.vertical), floors_(config.floors) {}

  /// `variance_m2`: of the height 0 by now, where this is the first reading.
  void add(const PressureSample& sample, bool walking, double variance_m2);
  /// A step of the walker: on stairs there are some to each metre, in a lift hardly any.
  void add_step() { floors_.add_step(); }

  [[nodiscard]] bool known() const { return reference_pa_.has_value(); }
  /// Carried on by the vertical speed for the second that a slow barometer leaves open.
  [[nodiscard]] double height_m(TimestampNs stamp_ns) const;
  /// Grows while the barometer is silent.
  [[nodiscard]] double variance_m2(TimestampNs stamp_ns) const;
  [[nodiscard]] double speed_mps() const { return filter_.speed_mps(); }
  /// Probability that the height changes now.
  [[nodiscard]] double climbing() const { return known() ? filter_.climbing() : 0.0; }
  [[nodiscard]] const FloorTracker& floors() const { return floors_; }

 private:
  void close_block(bool walking);
  double learn_noise(double reading_m, double dt_s);

  HeightConfig config_;
  VerticalFilter filter_;
  FloorTracker floors_;
  std::optional<double> reference_pa_;
  TimestampNs filter_ns_ = 0;  ///< of the filter's state
  TimestampNs block_end_ns_ = 0;
  // The block under way: sums of differences to its first sample.
  TimestampNs first_ns_ = 0;
  double time_sum_s_ = 0.0;
  double pressure_sum_pa_ = 0.0;
  double first_pa_ = 0.0;
  int samples_ = 0;
  // The last two readings, for the noise.
  double last_m_ = 0.0;
  double last_slope_mps_ = 0.0;
  int readings_ = 0;
  double noise_m2_ = 0.0;
};

}  // namespace vpdr::pdr
