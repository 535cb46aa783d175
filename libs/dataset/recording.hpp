#pragma once
// A recorded walk: the samples of its sensors, its images, what is known about it and the truth it
// carries. docs/recordings.md describes the folder.
//
// Axes: samples are in the SENSOR's axes, as recorded; apply_mount() turns them to the body's
// (forward, left, up). Truth attitudes are sensor to world (ENU) and stay so. SI units, microtesla,
// int64 nanoseconds of the recording's own clock.
// Thread safety: plain values; read_recording is reentrant.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/samples.hpp"
#include "dataset/camera_calibration.hpp"
#include "dataset/read_report.hpp"

namespace vpdr::dataset {

/// One image of the camera.
struct ImageEntry {
  TimestampNs stamp_ns = 0;
  std::filesystem::path file;
};

/// Half-open interval of the recording's clock: begin <= t < end.
struct Interval {
  TimestampNs begin_ns = 0;
  TimestampNs end_ns = 0;
  [[nodiscard]] bool contains(TimestampNs t) const { return begin_ns <= t && t < end_ns; }
};

/// What about.yaml says. A folder without the file has the defaults.
struct About {
  std::string dataset;
  std::string trial;
  std::string carry;  ///< how the device was worn, in words
  /// Body from sensor. Identity, unless about.yaml names `mount: {forward: "+y", up: "+z"}` or the
  /// carry text begins with "hand, flat" (a phone: forward +y, up +z).
  Eigen::Matrix3d mount = Eigen::Matrix3d::Identity();
  double declination_rad = 0.0;  ///< of the magnetic field at the place; positive to the east
  std::optional<double> rate_hz;
  std::optional<double> true_steps;  ///< counted by others over the whole recording
  std::optional<double> height_m;    ///< of the walker
  std::optional<bool> magnetic_disturbance;
  std::vector<Interval> reference_faults;       ///< where the attitude reference is wrong
  std::optional<std::filesystem::path> camera;  ///< calibration file named by `camera:`
};

/// Reference pose. Unknown parts are nan.
struct TruthPose {
  TimestampNs stamp_ns = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond world_from_sensor = Eigen::Quaterniond::Identity();
  [[nodiscard]] bool has_position() const { return position_m.allFinite(); }
  [[nodiscard]] bool has_attitude() const { return world_from_sensor.coeffs().allFinite(); }
};

/// Surveyed place where the walker stood at the instant.
struct Waypoint {
  TimestampNs stamp_ns = 0;
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();  ///< east, north
};

/// One true step (foot contact). The length is nan where unknown.
struct TrueStep {
  TimestampNs stamp_ns = 0;
  double length_m = 0.0;
};

/// One true stride: two steps, from a contact to the next of the same foot. nan where unknown.
struct TrueStride {
  TimestampNs begin_ns = 0;
  TimestampNs end_ns = 0;
  double length_m = 0.0;
};

/// The truth a recording carries; empty where it has none.
struct Truth {
  std::vector<TruthPose> poses;
  /// Where attitude errors count (movement.csv == 1); nullopt: everywhere.
  std::optional<std::vector<Interval>> movement;
  std::vector<Waypoint> waypoints;
  std::vector<TrueStep> steps;
  std::vector<TrueStride> strides;
  /// Where `steps` is complete (the walking bouts of reference.json); nullopt: everywhere.
  std::optional<std::vector<Interval>> walking_bouts;
};

/// A recorded walk.
struct Recording {
  std::filesystem::path folder;
  std::string name;  ///< last part of the folder's path
  std::vector<ImuSample> imu;
  std::vector<MagSample> mag;
  std::vector<PressureSample> pressure;
  std::vector<ImageEntry> images;
  std::optional<std::filesystem::path> video;  ///< instead of images; without stamps
  std::optional<CameraCalibration> camera;
  About about;
  Truth truth;
  ReadReport report;
};

/// How to read.
struct ReadOptions {
  bool images = true;                      ///< false: neither images, video nor calibration
  bool truth = true;                       ///< false: samples only
  double nominal_image_rate_hz = 20.0;     ///< of images that carry no stamps
  std::optional<Eigen::Matrix3d> mount{};  ///< overrides about.yaml
};

/// Reads a recording folder, EuRoC's `mav0/` layout or a folder of images; every table plain or
/// `.xz`. Bad rows are refused and counted in `report`. Throws FileFault, with place and remedy,
/// where the folder holds no recording, a table has an unknown column or no usable row, or a file
/// is damaged.
Recording read_recording(const std::filesystem::path& folder, const ReadOptions& options = {});

/// Turns samples and camera extrinsics from sensor to body axes by about.mount, which becomes the
/// identity; truth attitudes become body to world. Calling it twice changes nothing more.
void apply_mount(Recording& recording);

/// Axes of a mount from the sensor axes that point forward and up: ("+y", "+z"). nullopt where a
/// name is none of +x -x +y -y +z -z or both are along one axis.
std::optional<Eigen::Matrix3d> mount_from_axes(std::string_view forward, std::string_view up);

}  // namespace vpdr::dataset
