#pragma once
// Bias of a gyroscope at rest, and how it goes with temperature.
#include <vector>

#include "calibration/rest_intervals.hpp"
#include "core/result.hpp"

namespace vpdr::calibration {

struct GyroscopeConfig {
  double bin_s = 5.0;               ///< rests are taken in pieces of this length
  double min_rest_s = 3.0;          ///< in all
  double slope_sigma_radps = 2e-3;  ///< expected change of the bias for each degree
  double max_bias_radps = 0.35;     ///< 20 deg/s: data sheets' worst
};

/// bias(T) = bias + slope (T - temperature).
struct GyroscopeBias {
  Eigen::Vector3d bias_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d slope_radps_per_c = Eigen::Vector3d::Zero();
  double temperature_c = 0.0;  ///< mean; the slope is zero where it is not known
  double temperature_span_c = 0.0;
  double rest_s = 0.0;                                       ///< length of all rests
  Eigen::Vector3d wander_radps = Eigen::Vector3d::Zero();    ///< of the pieces about their mean
  Eigen::Vector3d residual_radps = Eigen::Vector3d::Zero();  ///< with the slope taken out
  Eigen::Vector3d noise_radps = Eigen::Vector3d::Zero();     ///< what a piece's white noise makes

  [[nodiscard]] Eigen::Vector3d at(double celsius) const {
    return bias_radps + slope_radps_per_c * (celsius - temperature_c);
  }
};

/// Refuses where the board did not rest long enough, or turned evenly instead of resting.
Result<GyroscopeBias> calibrate_gyroscope(const SensorStreams& streams,
                                          const std::vector<Rest>& rests,
                                          const GyroscopeConfig& config = {});

}  // namespace vpdr::calibration
