#pragma once
// Allan deviation of a sensor at rest: its noise density and bias instability (IEEE Std 952,
// annex C).
#include <vector>

#include "core/result.hpp"
#include "core/sensor_streams.hpp"

namespace vpdr::calibration {

struct AllanPoint {
  double tau_s = 0.0;
  Eigen::Vector3d deviation = Eigen::Vector3d::Zero();  ///< unit of the sensor
};

struct AllanDeviation {
  std::vector<AllanPoint> curve;                            ///< octaves of tau
  Eigen::Vector3d noise_density = Eigen::Vector3d::Zero();  ///< unit / sqrt(Hz)
  /// The curve's lowest point over 0.664: flicker of the bias. An upper bound where the curve still
  /// falls at its end.
  Eigen::Vector3d bias_instability = Eigen::Vector3d::Zero();
  double duration_s = 0.0;
};

/// Of samples with begin <= stamp < end, overlapping estimator. The stamps need not be regular: the
/// running integral is taken at regular instants. Refuses less than 30 s.
Result<AllanDeviation> allan_deviation(const std::vector<TimedVector>& stream, TimestampNs begin_ns,
                                       TimestampNs end_ns);

}  // namespace vpdr::calibration
