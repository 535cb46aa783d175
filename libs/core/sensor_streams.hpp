#pragma once
// Sensors as streams of their own, each with its own clock ticks: what calibration works on, where
// nothing is known yet of how one sensor's axes lie to another's.
#include <Eigen/Core>
#include <vector>

#include "core/time.hpp"

namespace vpdr {

/// One reading of a three-axis sensor, in its own axes.
struct TimedVector {
  TimestampNs stamp_ns = 0;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
};

/// One reading of a scalar sensor.
struct TimedValue {
  TimestampNs stamp_ns = 0;
  double value = 0.0;
};

/// The streams of one board in stamp order; empty where the board has no such sensor.
struct SensorStreams {
  std::vector<TimedVector> force_mps2;
  std::vector<TimedVector> rate_radps;
  std::vector<TimedVector> field_ut;
  std::vector<TimedValue> temperature_c;
};

}  // namespace vpdr
