#pragma once
// Calibration of an accelerometer: at rest it reads gravity's length, whichever way it lies.
#include "calibration/ellipsoid_fit.hpp"
#include "calibration/rest_intervals.hpp"
#include "core/result.hpp"
#include "core/samples.hpp"

namespace vpdr::calibration {

struct AccelerometerConfig {
  double gravity_mps2 = kGravityMps2;
  double scale_sigma = 0.03;      ///< data sheets: scale within 3 %,
  double skew_sigma = 0.006;      ///< axes within 2 % at the worst
  double bias_sigma_mps2 = 1.0;   ///< zero offset within 0.1 g
  double pose_sigma_mps2 = 0.02;  ///< what a pose is good for: nonlinearity, a soft table
  /// Between the rests, readings taken from time to time count little, but they see the directions
  /// in which the board cannot stand. Their deviation is their scatter, and this at the least.
  double motion_sigma_mps2 = 0.2;
  double motion_interval_s = 0.2;
  double motion_rate_radps = 2.0;  ///< faster turns are left out
  std::size_t min_poses = 3;
  double max_length_sigma = 0.015;  ///< of gravity, in the direction known least
};

struct AccelerometerCalibration {
  LinearCorrection correction;  ///< m/s^2
  std::size_t rests = 0;
  std::size_t poses = 0;
  double rms_before = 0.0;  ///< of the rests, share of gravity
  double rms = 0.0;
  double worst_sigma = 0.0;  ///< of the length in the direction known least, share of gravity
};

/// Refuses poor coverage: the error says which way the board has yet to lie.
Result<AccelerometerCalibration> calibrate_accelerometer(const SensorStreams& streams,
                                                         const std::vector<Rest>& rests,
                                                         const AccelerometerConfig& config = {});

}  // namespace vpdr::calibration
