#pragma once
// What diagnostics tell of the streams that leave the gateway and of the board they come from.
#include <string>

#include "app/health.hpp"
#include "core/sample_gate.hpp"
#include "imu_gateway/core/sensor_watch.hpp"
#include "imu_gateway/core/stream_watch.hpp"
#include "imu_gateway/source/sample_source.hpp"

namespace vpdr::imu_gateway {

/// One stream: "imu", "mag" or "pressure". Not thread-safe.
class StreamReport {
 public:
  explicit StreamReport(std::string name);

  /// Whether the sample may go out. Counts it either way.
  bool watch(const ImuSample& sample);
  bool watch(const MagSample& sample);
  bool watch(const PressureSample& sample);

  [[nodiscard]] std::uint64_t published() const { return gate_.accepted(); }
  /// Counters, and for a live board: degraded where a sensor is stuck.
  void report(bool live, app::Health& health) const;

 private:
  std::string name_;
  SampleGate gate_;
  StreamWatch stamps_;
  SensorWatch accelerometer_;
  SensorWatch gyroscope_;
  SensorWatch magnetometer_;
};

/// Counters of a live board: parser, clock, connection. `prefix`: "serial".
void report_source(const SourceHealth& source, const std::string& prefix, app::Health& health);

}  // namespace vpdr::imu_gateway
