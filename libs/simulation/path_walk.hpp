#pragma once
// A walk that somebody recorded with a reference, but no camera: its samples as they are, or
// simulated ones, and pictures rendered along the reference in a place made around it.
#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/samples.hpp"
#include "dataset/camera_calibration.hpp"
#include "simulation/path_imu.hpp"
#include "simulation/reference_path.hpp"
#include "simulation/render/room_around.hpp"
#include "simulation/render/shot.hpp"

namespace vpdr::simulation {

struct PathWalkOptions {
  /// A recording folder (docs/recordings.md), or a file of poses: groundtruth.csv of one, EuRoC's,
  /// or TUM text (.txt).
  std::filesystem::path path;
  std::filesystem::path imu;       ///< table of inertial samples beside a file of poses
  std::optional<Camera> camera{};  ///< none: the recording's own, else one that looks ahead
  std::optional<Eigen::Matrix3d> body_from_sensor{};  ///< none: what the recording says
  /// Inertial samples are simulated; any recorded ones are left out.
  std::optional<PathImuOptions> simulated_imu{};
  double camera_rate_hz = 20.0;
  bool smooth = true;  ///< take the reference's noise off with the gyroscope, where there is one
  RoomOptions room;
};

struct PathWalk {
  std::string source;  ///< name of the recording
  bool simulated_imu = false;
  std::vector<ImuSample> imu;
  std::vector<MagSample> mag;
  std::vector<PressureSample> pressure;
  Eigen::Matrix3d body_from_sensor;  ///< the board's mount
  double declination_rad = 0.0;
  double camera_rate_hz = 0.0;
  ReferencePath path;  ///< the pictures' truth, of the sensor; attitude sensor to world
  Shot shot;           ///< its camera sits in the sensor's axes
};

/// Reads the recording and makes the place. Throws FileFault, and ConfigurationFault where there
/// is no reference.
PathWalk read_path_walk(const PathWalkOptions& options);

/// The camera of a calibration file.
Camera camera_of(const dataset::CameraCalibration& calibration);

}  // namespace vpdr::simulation
