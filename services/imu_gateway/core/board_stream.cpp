#include "imu_gateway/core/board_stream.hpp"

namespace vpdr::imu_gateway {
namespace {

constexpr TimestampNs kBurstNs = 20'000'000;
constexpr double kColdest_c = -60.0;
constexpr double kHottest_c = 150.0;

std::size_t kind_of(const BoardReadings& readings) {
  return (readings.specific_force_mps2 ? 1U : 0U) | (readings.angular_velocity_radps ? 2U : 0U) |
         (readings.field_ut ? 4U : 0U) | (readings.pressure_pa ? 8U : 0U);
}

}  // namespace

void BoardStream::restart() {
  clock_.restart();
  for (RegularClock& clock : regular_clocks_) clock.restart();
  pairing_.restart();
  gyroscope_is_apart_ = false;
}

StreamHealth BoardStream::health() const {
  StreamHealth health;
  health.clock = clock_.health();
  for (const RegularClock& clock : regular_clocks_) health.missing += clock.health().missing;
  health.bursts = bursts_;
  health.unpaired = pairing_.unpaired();
  health.temperature_c = temperature_c_;
  health.odd_temperatures = odd_temperatures_;
  return health;
}

std::optional<TimestampNs> BoardStream::stamp_of(const BoardReadings& readings,
                                                 TimestampNs arrival_ns) {
  if (!readings.board_stamp_ns) {
    return regular_clocks_[kind_of(readings)].host_stamp(arrival_ns);
  }
  return clock_.host_stamp(*readings.board_stamp_ns, readings.clock_wraps_at_ns, arrival_ns);
}

void BoardStream::watch_bursts(TimestampNs stamp_ns, TimestampNs arrival_ns) {
  if (arrival_ns != burst_arrival_ns_) {
    burst_arrival_ns_ = arrival_ns;
    burst_begin_ns_ = stamp_ns;
    burst_is_counted_ = false;
  } else if (!burst_is_counted_ && stamp_ns - burst_begin_ns_ > kBurstNs) {
    burst_is_counted_ = true;
    ++bursts_;
  }
}

void BoardStream::take_temperature(double celsius) {
  if (celsius >= kColdest_c && celsius <= kHottest_c) {
    temperature_c_ = celsius;
  } else {
    ++odd_temperatures_;
  }
}

void BoardStream::accept(const BoardReadings& readings, TimestampNs arrival_ns,
                         std::vector<Reading>& out) {
  if (readings.temperature_c) take_temperature(*readings.temperature_c);
  if (kind_of(readings) == 0) return;
  const auto stamp_ns = stamp_of(readings, arrival_ns);
  if (!stamp_ns) return;
  watch_bursts(*stamp_ns, arrival_ns);
  emit(readings, *stamp_ns, out);
}

void BoardStream::accept_as_stamped(const BoardReadings& readings, std::vector<Reading>& out) {
  if (readings.temperature_c) take_temperature(*readings.temperature_c);
  if (readings.board_stamp_ns) emit(readings, *readings.board_stamp_ns, out);
}

void BoardStream::emit(const BoardReadings& readings, TimestampNs stamp_ns,
                       std::vector<Reading>& out) {
  if (readings.field_ut) {
    out.emplace_back(MagSample{stamp_ns, axes_.mount * axes_.magnetometer * *readings.field_ut});
  }
  if (readings.pressure_pa) out.emplace_back(PressureSample{stamp_ns, *readings.pressure_pa});
  accept_inertial(readings, stamp_ns, out);
}

void BoardStream::accept_inertial(const BoardReadings& readings, TimestampNs stamp_ns,
                                  std::vector<Reading>& out) {
  ImuSample sample;
  sample.stamp_ns = stamp_ns;
  const bool has_force = readings.specific_force_mps2.has_value();
  sample.has_angular_velocity = readings.angular_velocity_radps.has_value();
  if (has_force) {
    sample.specific_force_mps2 = axes_.mount * axes_.accelerometer * *readings.specific_force_mps2;
  }
  if (sample.has_angular_velocity) {
    sample.angular_velocity_radps =
        axes_.mount * axes_.gyroscope * *readings.angular_velocity_radps;
  }
  gyroscope_is_apart_ = gyroscope_is_apart_ || (sample.has_angular_velocity && !has_force);
  if (has_force && (sample.has_angular_velocity || !gyroscope_is_apart_)) {
    out.emplace_back(sample);
    return;
  }
  paired_.clear();
  if (has_force) pairing_.add_force(stamp_ns, sample.specific_force_mps2, paired_);
  if (!has_force && sample.has_angular_velocity) {
    pairing_.add_rate(stamp_ns, sample.angular_velocity_radps, paired_);
  }
  for (const ImuSample& paired : paired_) out.emplace_back(paired);
}

}  // namespace vpdr::imu_gateway
