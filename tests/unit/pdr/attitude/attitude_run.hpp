#pragma once
// Runs an attitude filter over made readings.
#include <algorithm>

#include "core/time.hpp"
#include "pdr/core/attitude/attitude_filter.hpp"
#include "tests/unit/pdr/made_walk.hpp"

namespace vpdr::pdr::made {

/// Sensors of the tests read instants: nothing to make up for.
inline AttitudeConfig prompt_sensors() {
  AttitudeConfig config;
  config.sensor_delay_s = 0.0;
  config.magnetic.delay_s = 0.0;
  return config;
}

/// Feeds everything in the order of the stamps and returns the largest error after `from_s`, rad.
inline double largest_error(AttitudeFilter& filter, const Readings& readings, double from_s = 0.0) {
  double largest = 0.0;
  const TimestampNs start = readings.imu.front().stamp_ns;
  std::size_t mag = 0;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    while (mag < readings.mag.size() && readings.mag[mag].stamp_ns <= readings.imu[i].stamp_ns) {
      filter.process(readings.mag[mag++]);
    }
    filter.process(readings.imu[i]);
    if (to_seconds(readings.imu[i].stamp_ns - start) < from_s) continue;
    largest = std::max(largest, filter.world_from_body().angularDistance(readings.truth[i]));
  }
  return largest;
}

}  // namespace vpdr::pdr::made
