#pragma once
// Camera calibration as recordings carry it: EuRoC sensor.yaml, Kalibr camchain.yaml, ROS
// camera_info. Camera axes: x right, y down, z forward. Pixels and metres.
#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace vpdr::dataset {

/// Lens model of the coefficients.
enum class Distortion {
  kNone,
  kRadialTangential,  ///< k1 k2 p1 p2 [k3 ...]: OpenCV's pinhole, ROS plumb_bob
  kEquidistant,       ///< k1 k2 k3 k4: OpenCV's fisheye
};

/// A pinhole camera. `body_from_camera` is relative to the IMU's own axes until apply_mount() has
/// turned the recording to the body's.
struct CameraCalibration {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;
  Distortion distortion = Distortion::kNone;
  std::vector<double> coefficients;
  int width = 0, height = 0;
  Eigen::Matrix4d body_from_camera = Eigen::Matrix4d::Identity();
  double rate_hz = 0.0;  ///< 0: the file does not say
};

/// Reads any of the three kinds; throws FileFault naming file, line, key and remedy.
CameraCalibration read_camera_calibration(const std::filesystem::path& file);

}  // namespace vpdr::dataset
