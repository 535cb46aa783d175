#include "simulation/path_walk.hpp"

#include <algorithm>
#include <utility>

#include "core/errors.hpp"
#include "dataset/recording.hpp"
#include "dataset/sample_tables.hpp"
#include "dataset/truth_tables.hpp"
#include "simulation/path_smoothing.hpp"

namespace vpdr::simulation {
namespace {

namespace fs = std::filesystem;

dataset::Recording read_files(const PathWalkOptions& options) {
  dataset::Recording recording;
  recording.name = options.path.stem().string();
  recording.truth.poses = options.path.extension() == ".txt"
                              ? dataset::read_tum(options.path, recording.report)
                              : dataset::read_groundtruth_table(options.path, recording.report);
  if (!options.imu.empty()) {
    recording.imu = dataset::read_imu_table(options.imu, recording.report);
  }
  return recording;
}

std::vector<PathPose> poses_of(const dataset::Recording& recording) {
  std::vector<PathPose> poses;
  for (const dataset::TruthPose& pose : recording.truth.poses) {
    poses.push_back({pose.stamp_ns, pose.position_m, pose.world_from_sensor});
  }
  return poses;
}

/// A camera that looks ahead on the body sits in the sensor's axes as the board is mounted.
Camera in_sensor_axes(Camera camera, const Eigen::Matrix3d& body_from_sensor) {
  Eigen::Isometry3d sensor_from_body = Eigen::Isometry3d::Identity();
  sensor_from_body.linear() = body_from_sensor.transpose();
  camera.body_from_camera = sensor_from_body * camera.body_from_camera;
  return camera;
}

}  // namespace

Camera camera_of(const dataset::CameraCalibration& calibration) {
  Camera camera;
  camera.width = calibration.width;
  camera.height = calibration.height;
  camera.fx = calibration.fx;
  camera.fy = calibration.fy;
  camera.cx = calibration.cx;
  camera.cy = calibration.cy;
  camera.lens = calibration.distortion == dataset::Distortion::kEquidistant
                    ? Lens::kEquidistant
                    : Lens::kRadialTangential;
  camera.distortion = {};
  if (calibration.coefficients.size() > camera.distortion.size()) {
    throw ConfigurationFault("simulate: a camera with more than five coefficients of distortion");
  }
  std::copy(calibration.coefficients.begin(), calibration.coefficients.end(),
            camera.distortion.begin());
  if (!(camera.width > 0 && camera.height > 0)) {
    throw ConfigurationFault("simulate: the camera's file names no resolution");
  }
  camera.body_from_camera = Eigen::Isometry3d(calibration.body_from_camera);
  return camera;
}

PathWalk read_path_walk(const PathWalkOptions& options) {
  dataset::Recording recording =
      fs::is_directory(options.path) ? dataset::read_recording(options.path) : read_files(options);
  if (recording.truth.poses.empty()) {
    throw ConfigurationFault(options.path.string() + ": has no reference to render pictures along");
  }
  const Eigen::Matrix3d mount = options.body_from_sensor.value_or(recording.about.mount);
  ReferencePath path(poses_of(recording));
  if (options.simulated_imu) {
    InertialPath inertial = imu_along(path, mount, *options.simulated_imu);
    path = std::move(inertial.path);
    recording.imu = std::move(inertial.imu);
    recording.mag.clear();
    recording.pressure.clear();
  } else if (options.smooth) {
    path = smooth_with_gyroscope(path, recording.imu);
  }
  Camera camera = in_sensor_axes({}, mount);
  if (options.camera) {
    camera = *options.camera;
  } else if (recording.camera) {
    camera = camera_of(*recording.camera);
  }
  std::vector<TimestampNs> frames = frames_along(path, options.camera_rate_hz);
  Shot shot =
      shot_in(surround(path, options.room), path, camera, options.room.seed, std::move(frames));
  return {.source = recording.name,
          .simulated_imu = options.simulated_imu.has_value(),
          .imu = std::move(recording.imu),
          .mag = std::move(recording.mag),
          .pressure = std::move(recording.pressure),
          .body_from_sensor = mount,
          .declination_rad = recording.about.declination_rad,
          .camera_rate_hz = options.camera_rate_hz,
          .path = std::move(path),
          .shot = std::move(shot)};
}

}  // namespace vpdr::simulation
