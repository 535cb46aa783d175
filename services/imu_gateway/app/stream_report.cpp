#include "imu_gateway/app/stream_report.hpp"

#include <cstdio>
#include <utility>

namespace vpdr::imu_gateway {
namespace {

// Full scales in use begin at 2 g, 250 deg/s and 0.88 G.
constexpr SensorWatchOptions kAccelerometer{.least_full_scale = 15.0};
constexpr SensorWatchOptions kGyroscope{.least_full_scale = 4.0};
// A magnetometer of one milligauss a count may well repeat itself at rest for a while.
constexpr SensorWatchOptions kMagnetometer{
    .stuck_after_s = 5.0, .stuck_samples = 60, .least_full_scale = 80.0};

std::string decimal(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3f", value);
  return text.data();
}

void report_sensor(const SensorWatch& sensor, const std::string& name, bool live,
                   app::Health& health) {
  health.count(name + ".stuck", sensor.stuck());
  health.count(name + ".saturated", sensor.saturated());
  const std::string axes(sensor.stuck_axes());
  if (live && !axes.empty()) {
    health.degrade(name + " is stuck: " + axes + " repeats one value to the last bit",
                   "power the board off and on; check the sensor's bus and its set-up");
  }
}

}  // namespace

StreamReport::StreamReport(std::string name)
    : name_(std::move(name)),
      accelerometer_(kAccelerometer),
      gyroscope_(kGyroscope),
      magnetometer_(kMagnetometer) {}

bool StreamReport::watch(const ImuSample& sample) {
  if (gate_.check(sample) != Refusal::kNone) return false;
  stamps_.see(sample.stamp_ns);
  accelerometer_.see(sample.stamp_ns, sample.specific_force_mps2);
  if (sample.has_angular_velocity) {
    gyroscope_.see(sample.stamp_ns, sample.angular_velocity_radps);
  }
  return true;
}

bool StreamReport::watch(const MagSample& sample) {
  if (gate_.check(sample) != Refusal::kNone) return false;
  stamps_.see(sample.stamp_ns);
  magnetometer_.see(sample.stamp_ns, sample.field_ut);
  return true;
}

bool StreamReport::watch(const PressureSample& sample) {
  if (gate_.check(sample) != Refusal::kNone) return false;
  stamps_.see(sample.stamp_ns);
  return true;
}

void StreamReport::report(bool live, app::Health& health) const {
  health.count(name_ + ".published", gate_.accepted());
  health.count_refusals(name_, gate_);
  health.note(name_ + ".rate_hz", decimal(stamps_.rate_hz()));
  health.count(name_ + ".gaps", stamps_.gaps());
  health.count(name_ + ".missing", stamps_.missing());
  if (name_ == "imu") {
    report_sensor(accelerometer_, "accelerometer", live, health);
    report_sensor(gyroscope_, "gyroscope", live, health);
  }
  if (name_ == "mag") report_sensor(magnetometer_, "magnetometer", live, health);
}

void report_source(const SourceHealth& source, const std::string& prefix, app::Health& health) {
  const auto count = [&](const char* name, std::uint64_t value) {
    health.count(prefix + "." + name, value);
  };
  const auto note = [&](const char* name, double value) {
    health.note(prefix + "." + name, decimal(value));
  };
  count("malformed", source.parser.malformed);
  count("unknown_layout", source.parser.unknown_layout);
  count("overlong", source.parser.overlong);
  count("incomplete", source.parser.incomplete);
  count("lost", source.parser.lost);
  count("duplicates", source.parser.duplicates);
  count("reconnections", source.reconnections);
  count("missing", source.stream.missing);
  count("bursts", source.stream.bursts);
  count("unpaired", source.stream.unpaired);
  count("odd_temperatures", source.stream.odd_temperatures);
  const ClockHealth& clock = source.stream.clock;
  count("clock_resets", clock.resets);
  count("clock_wraps", clock.wraps);
  count("clock_outliers", clock.outliers);
  note("clock_skew_ppm", clock.skew_ppm);
  note("clock_jitter_ms", clock.jitter_ms);
  note("clock_worst_delay_ms", clock.worst_delay_ms);
  if (source.stream.temperature_c) note("temperature_c", *source.stream.temperature_c);
}

}  // namespace vpdr::imu_gateway
