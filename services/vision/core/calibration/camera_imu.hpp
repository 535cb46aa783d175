#pragma once
// How a camera is turned against the inertial sensor it is fixed to, and how far their clocks are
// apart, from half a minute of waving both by hand: the turns that the camera sees between its
// frames against those that the gyroscope measures. The gyroscope's bias is estimated besides.
// Camera axes: x right, y down, z forward; seconds and radians. Pure functions, thread-safe; what
// cannot be calibrated is an Error with its remedy.
//
// 1. Clocks: the offset at which the two rates' sizes, which know no axes, correlate best.
// 2. Rotation and bias at that offset: the rigid alignment of two sets of rates (Kabsch 1976).
// 3. All seven together by Gauss-Newton with Tukey weights: the turn by the gyroscope between
//    t + offset of one frame and of the next, bias taken off, against the camera's, turned.
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/result.hpp"
#include "core/samples.hpp"
#include "core/time.hpp"

namespace vpdr::vision {

/// What the camera saw between two frames.
struct VisualTurn {
  TimestampNs start_ns = 0;  ///< stamps of the camera's clock
  TimestampNs end_ns = 0;
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  ///< earlier from later, camera axes
};

struct CameraImuConfig {
  double max_offset_s = 0.5;     ///< searched both ways
  double offset_step_s = 0.004;  ///< of that search
  double max_gap_s = 0.1;        ///< inertial samples further apart are not integrated
  double min_rate_radps = 0.15;  ///< RMS about the second axis: less does not tell the rotation
  double min_correlation = 0.6;  ///< of the rates' sizes
  std::size_t min_turns = 50;
  int iterations = 15;
};

struct CameraImuCalibration {
  Eigen::Matrix3d imu_from_camera = Eigen::Matrix3d::Identity();
  double timeshift_s = 0.0;  ///< IMU time of a frame is its stamp plus this (Kalibr's)
  Eigen::Vector3d gyro_bias_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_sigma_rad = Eigen::Vector3d::Zero();  ///< about the IMU's axes
  double timeshift_sigma_s = 0.0;
  double rms_rad = 0.0;  ///< of a turn, over the turns that count
  std::size_t turns = 0;
  std::size_t outliers = 0;  ///< turns that fit nothing: a bad frame
};

Result<CameraImuCalibration> align_camera_imu(const std::vector<VisualTurn>& turns,
                                              const std::vector<ImuSample>& imu,
                                              const CameraImuConfig& config);

}  // namespace vpdr::vision
