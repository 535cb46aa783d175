#pragma once
// Turns of the board as gyroscope and direction sensors saw them.
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "calibration/rate_alignment.hpp"
#include "core/sensor_streams.hpp"

namespace vpdr::calibration {

struct TurnConfig {
  double window_s = 0.8;   ///< length of a turn
  double smooth_s = 0.06;  ///< directions are means over this time
  double min_angle_rad = 0.1;
  double max_angle_rad = 1.5;
  double max_gap_s = 0.12;        ///< between samples of the gyroscope
  double saturation_radps = 4.3;  ///< faster readings may be cut off: 250 deg/s
  double sigma = 0.01;            ///< of a direction's change, radians
};

/// Matrix from gyroscope axes to the axes of `directions`, by all the turns of a recording.
/// nullopt: too few of them, or about too few axes.
std::optional<RateAlignment::Solution> align_rates(const std::vector<TimedVector>& rates,
                                                   const Eigen::Vector3d& bias_radps,
                                                   const std::vector<TimedVector>& directions,
                                                   const TurnConfig& config = {});

/// Angle turned from begin to end (rotation vectors' chain, body axes): of each axis by itself, the
/// trapezoid over the samples. For turns about one axis.
Eigen::Vector3d integrated_turn(const std::vector<TimedVector>& rates, TimestampNs begin_ns,
                                TimestampNs end_ns);

}  // namespace vpdr::calibration
