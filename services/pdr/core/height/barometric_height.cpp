#include "pdr/core/height/barometric_height.hpp"

#include <algorithm>
#include <cmath>

#include "core/square.hpp"

namespace vpdr::pdr {

namespace {

/// Lapse rate of the standard atmosphere, K/m, and R L / g of dry air (ICAO Doc 7488).
constexpr double kLapse = 0.0065;
constexpr double kExponent = 287.05287 * kLapse / kGravityMps2;
/// A block is full that is so near its length: samples come a little early or late.
constexpr double kFull = 0.9;
/// Noise of a barometer of which nothing is known yet, m.
constexpr double kFirstNoise = 0.3;
/// Share of one misfit in what is learned of the noise.
constexpr double kNoiseGain = 0.05;
/// A misfit larger than so many deviations is no noise.
constexpr double kNoiseGate = 9.0;
/// Nobody climbs so fast, Pa from the first reading to the end of the first block: 8 m.
constexpr double kLargestJump_pa = 100.0;
/// The filter's speed carries the height on no further, s.
constexpr double kAhead = 1.0;

}  // namespace

double barometric_height_m(double pressure_pa, double reference_pa, double temperature_k) {
  return temperature_k / kLapse * (1.0 - std::pow(pressure_pa / reference_pa, kExponent));
}

void BarometricHeight::add(const PressureSample& sample, bool walking, double variance_m2) {
  // A sensor's first reading may be what its registers held: the next ones bear it out or not.
  const bool untried = reference_pa_ && readings_ == 0;
  if (untried && std::abs(sample.pressure_pa - *reference_pa_) > kLargestJump_pa) {
    reference_pa_.reset();
  }
  if (!reference_pa_) {
    reference_pa_ = sample.pressure_pa;
    noise_m2_ = square(std::max(config_.noise_m, kFirstNoise));
    filter_.start(0.0, variance_m2, 0.0, noise_m2_);
    filter_ns_ = block_end_ns_ = sample.stamp_ns;
    return;
  }
  if (sample.stamp_ns < block_end_ns_) {  // the first stamps were wrong
    filter_ns_ = block_end_ns_ = sample.stamp_ns;
    samples_ = 0;
  }
  if (samples_ == 0) {
    first_ns_ = sample.stamp_ns;
    first_pa_ = sample.pressure_pa;
    time_sum_s_ = pressure_sum_pa_ = 0.0;
  }
  ++samples_;
  time_sum_s_ += to_seconds(sample.stamp_ns - first_ns_);
  pressure_sum_pa_ += sample.pressure_pa - first_pa_;
  if (to_seconds(sample.stamp_ns - block_end_ns_) < kFull * config_.period_s) return;
  block_end_ns_ = sample.stamp_ns;
  close_block(walking);
}

void BarometricHeight::close_block(bool walking) {
  const TimestampNs stamp_ns = first_ns_ + to_ns(time_sum_s_ / samples_);
  const double pressure_pa = first_pa_ + pressure_sum_pa_ / samples_;
  samples_ = 0;
  const double dt = to_seconds(stamp_ns - filter_ns_);
  filter_ns_ = stamp_ns;
  if (dt <= 0.0) return;
  const double reading = barometric_height_m(pressure_pa, *reference_pa_, config_.temperature_k);
  filter_.add(reading, learn_noise(reading, dt), dt, walking);
  floors_.add({stamp_ns, filter_.height_m(), filter_.speed_mps(), filter_.climbing(), walking});
}

/// Variance of a mean: what a reading differs by from the line through the two before is noise,
/// three readings' worth, whatever the speed.
double BarometricHeight::learn_noise(double reading_m, double dt_s) {
  const double slope = (reading_m - last_m_) / dt_s;
  if (readings_ >= 2) {
    const double seen = square((slope - last_slope_mps_) * dt_s) / 6.0;
    const double least = square(config_.noise_m);
    noise_m2_ += kNoiseGain * (std::clamp(seen, least, kNoiseGate * noise_m2_) - noise_m2_);
  }
  readings_ = std::min(readings_ + 1, 2);
  last_m_ = reading_m;
  last_slope_mps_ = slope;
  return noise_m2_;
}

double BarometricHeight::height_m(TimestampNs stamp_ns) const {
  const double since = std::clamp(to_seconds(stamp_ns - filter_ns_), 0.0, kAhead);
  return filter_.height_m() + since * filter_.speed_mps();
}

double BarometricHeight::variance_m2(TimestampNs stamp_ns) const {
  const double since = std::max(to_seconds(stamp_ns - filter_ns_), 0.0);
  const double silent = std::max(since - kAhead, 0.0);
  return filter_.height_variance_m2() +
         square(std::min(since, kAhead)) * filter_.speed_variance_m2ps2() +
         square(config_.stray_mps * silent);
}

}  // namespace vpdr::pdr
