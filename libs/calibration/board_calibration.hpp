#pragma once
// What is known of one board and of the way it is worn: the content of a calibration file.
//
//   read in sensor axes -> axes (which is which, and signs) -> correction -> mount -> body axes
//
// Corrections are in board axes: those of the accelerometer once its signs are right.
#include <algorithm>
#include <string>

#include "calibration/linear_correction.hpp"

namespace vpdr::calibration {

/// Of one three-axis sensor. `date` (ISO 8601, UTC) is empty where it was never calibrated.
struct SensorCalibration {
  std::string date;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< signed permutation, sensor to board
  LinearCorrection correction;                         ///< in board axes
  double residual_before = 0.0;                        ///< share of the true length; gyro: rad/s
  double residual = 0.0;

  /// From what the sensor reads to board axes.
  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& read) const {
    return correction.apply(axes * read);
  }
};

struct AccelerometerSection : SensorCalibration {  ///< m/s^2
  unsigned poses = 0;
  Eigen::Vector3d noise_density = Eigen::Vector3d::Zero();  ///< m/s^2/sqrt(Hz); 0: not measured
};

struct GyroscopeSection : SensorCalibration {  ///< rad/s; the residual is the bias' wander
  /// Change of the bias for each degree about `temperature_c`, known from there to `span_c` / 2 to
  /// either side.
  Eigen::Vector3d bias_slope = Eigen::Vector3d::Zero();
  double temperature_c = 0.0;
  double temperature_span_c = 0.0;
  Eigen::Vector3d noise_density = Eigen::Vector3d::Zero();     ///< rad/s/sqrt(Hz)
  Eigen::Vector3d bias_instability = Eigen::Vector3d::Zero();  ///< rad/s

  /// Change of the bias at that temperature, Celsius; beyond what was seen that at its edge.
  [[nodiscard]] Eigen::Vector3d bias_change(double celsius) const {
    const double half_span = 0.5 * temperature_span_c;
    return std::clamp(celsius - temperature_c, -half_span, half_span) * bias_slope;
  }
};

struct MagnetometerSection : SensorCalibration {  ///< microtesla
  double coverage = 0.0;                          ///< share of the sphere
  double field_ut = 0.0;
  double dip_rad = 0.0;  ///< below the horizon
};

struct MountSection {
  std::string date;
  Eigen::Matrix3d body_from_board = Eigen::Matrix3d::Identity();
  double walking_s = 0.0;
  double straightness = 0.0;
};

struct BoardCalibration {
  std::string board;   ///< kind, as "MPU6050 + HMC5883L"
  std::string serial;  ///< number of this one
  AccelerometerSection accelerometer;
  GyroscopeSection gyroscope;
  MagnetometerSection magnetometer;
  MountSection mount;
};

}  // namespace vpdr::calibration
