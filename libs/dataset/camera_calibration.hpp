#pragma once
// Camera calibration as recordings carry it: EuRoC sensor.yaml, Kalibr camchain.yaml, ROS
// camera_info; Kalibr's is written too. Camera axes: x right, y down, z forward. Pixels and metres.
#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vpdr::dataset {

/// Lens model of the coefficients.
enum class Distortion {
  kNone,
  kRadialTangential,  ///< k1 k2 p1 p2 [k3 ...]: OpenCV's pinhole, ROS plumb_bob
  kEquidistant,       ///< k1 k2 k3 k4: OpenCV's fisheye
};

/// A camera that looks forward and stands upright, in body axes (forward, left, up).
Eigen::Matrix4d forward_looking_body_from_camera();

/// A pinhole camera. Where the file says how the camera sits (`has_mounting`), `body_from_camera`
/// is relative to the IMU's own axes until apply_mount() has turned the recording to the body's;
/// where it does not, the camera is taken to look forward.
struct CameraCalibration {
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;
  Distortion distortion = Distortion::kNone;
  std::vector<double> coefficients;
  int width = 0, height = 0;
  Eigen::Matrix4d body_from_camera = forward_looking_body_from_camera();
  bool has_mounting = false;
  double timeshift_s = 0.0;         ///< a frame's IMU time is its own stamp plus this (Kalibr)
  std::optional<double> height_m;   ///< of the camera above the floor, where it was measured
  std::optional<double> pitch_rad;  ///< of its optical axis then, positive looking up
  double rate_hz = 0.0;             ///< 0: the file does not say
};

/// Reads any of the three kinds; throws FileFault naming file, line, key and remedy.
CameraCalibration read_camera_calibration(const std::filesystem::path& file);

/// Writes Kalibr's camchain layout, with height_m and pitch_rad where they are known, and
/// `remarks` as comments above it. Throws FileFault.
void write_camchain(const CameraCalibration& camera, const std::vector<std::string>& remarks,
                    const std::filesystem::path& file);

}  // namespace vpdr::dataset
