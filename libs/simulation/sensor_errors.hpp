#pragma once
// What real sensors do to the truth: noise, bias and its wander, scale, misalignment, quantisation.
// Defaults are those of a consumer MEMS board after factory calibration.
#include <Eigen/Core>

#include "simulation/random.hpp"

namespace vpdr::simulation {

/// Errors of a three-axis sensor. Unit U is the sensor's (m/s^2, rad/s or uT).
struct TriadErrors {
  double noise_density = 0.0;   ///< white noise, U/sqrt(Hz)
  double turn_on_bias = 0.0;    ///< standard deviation on each axis, U
  double bias_walk = 0.0;       ///< random walk of the bias, U/sqrt(s)
  double scale_error = 0.0;     ///< standard deviation on each axis, relative
  double misalignment_rad = 0;  ///< standard deviation of each off-diagonal term
  double quantum = 0.0;         ///< of the digital output, U; 0: none
};

struct SensorErrors {
  TriadErrors accelerometer{2.0e-3, 0.04, 1.0e-4, 0.003, 0.002, 8.0 * 9.80665 / 32768.0};
  TriadErrors gyroscope{1.5e-4, 0.005, 1.0e-5, 0.003, 0.002, 17.4533 / 32768.0};
  TriadErrors magnetometer{0.04, 0.6, 0.002, 0.006, 0.004, 0.15};
  double pressure_noise_pa = 2.0;    ///< of one sample, standard deviation
  double pressure_offset_pa = 60.0;  ///< turn-on, standard deviation
  double pressure_walk_pa = 0.4;     ///< weather and ventilation, Pa/sqrt(s)
  double pressure_quantum_pa = 0.1;
  double sea_level_pressure_pa = 101325.0;

  /// All errors zero.
  static SensorErrors none();
};

/// One three-axis sensor with its errors drawn. Not thread-safe.
class TriadSensor {
 public:
  TriadSensor(const TriadErrors& errors, double rate_hz, Random random);

  /// The reading for a true value, `interval_s` after the reading before.
  Eigen::Vector3d read(const Eigen::Vector3d& truth, double interval_s);

 private:
  Eigen::Vector3d normal(double standard_deviation);

  TriadErrors errors_;
  double noise_;  ///< standard deviation of one sample
  Random random_;
  Eigen::Matrix3d response_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d bias_ = Eigen::Vector3d::Zero();
};

/// A barometer on its storey. Not thread-safe.
class Barometer {
 public:
  Barometer(const SensorErrors& errors, Random random);
  /// Pressure at `height_m` above the floor, `interval_s` after the reading before.
  double read(double height_m, double interval_s);

 private:
  SensorErrors errors_;
  Random random_;
  double offset_pa_;
};

}  // namespace vpdr::simulation
