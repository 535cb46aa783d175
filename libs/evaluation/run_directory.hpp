#pragma once
// What a run of vpdr leaves in its folder DIR, in memory.
//
//   trajectory.tum             fused pose: t_s x y z qx qy qz qw
//   trajectory_covariance.csv  of the same rows: #timestamp [ns],var_x [m^2],var_y [m^2],
//                              cov_xy [m^2],var_yaw [rad^2]
//   pdr.tum                    dead-reckoned pose, as trajectory.tum
//   vision.tum                 visual odometry, as trajectory.tum; once its scale is known
//   attitude.csv               #timestamp [ns],q_w,q_x,q_y,q_z: body to ENU, one row an IMU sample
//   steps.csv                  #timestamp [ns],length [m],yaw [rad]
//   vision_heading.csv         #timestamp [ns],heading [rad],pitch [rad],sigma [rad]; where there
//                              are images
//   summary.json               {steps, distance_m, duration_s, speed_factor}
//   run.json                   what was run, latencies, topics (run_info.hpp); may be absent
//
// Stamps are the recording's; seconds in TUM files have nine decimals, so no nanosecond is lost.
// World ENU, body forward-left-up. RunWriter (run_writer.hpp) writes the folder.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "core/time.hpp"
#include "evaluation/run_info.hpp"

namespace vpdr::evaluation {

struct StampedPose {
  TimestampNs stamp_ns = 0;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond world_from_body = Eigen::Quaterniond::Identity();
};

struct StampedAttitude {
  TimestampNs stamp_ns = 0;
  Eigen::Quaterniond world_from_body = Eigen::Quaterniond::Identity();
};

/// Horizontal position covariance and yaw variance of a fused pose.
struct StampedCovariance {
  TimestampNs stamp_ns = 0;
  Eigen::Matrix2d position_m2 = Eigen::Matrix2d::Zero();
  double var_yaw_rad2 = 0.0;
};

struct RunStep {
  TimestampNs stamp_ns = 0;
  double length_m = 0.0;
  double yaw_rad = 0.0;
};

struct RunVisionHeading {
  TimestampNs stamp_ns = 0;
  double heading_rad = 0.0;
  double pitch_rad = 0.0;
  double sigma_rad = 0.0;
};

/// summary.json.
struct Summary {
  std::uint64_t steps = 0;
  double distance_m = 0.0;
  double duration_s = 0.0;    ///< of the recording, by its stamps
  double speed_factor = 0.0;  ///< duration divided by the time the run took
};

/// One run. Rows are in rising order of their stamps.
struct RunDirectory {
  std::filesystem::path folder;
  std::vector<StampedPose> fused;
  std::vector<StampedCovariance> covariance;  ///< empty, or one for each fused pose
  std::vector<StampedPose> pdr;
  std::vector<StampedAttitude> attitude;
  std::vector<RunStep> steps;
  std::vector<RunVisionHeading> vision_heading;
  Summary summary;
  RunInfo info;

  /// Reads DIR. Strict: a missing file (other than trajectory_covariance.csv, vision_heading.csv
  /// and run.json), an unknown column or a bad row throws FileFault with place and remedy.
  static RunDirectory read(const std::filesystem::path& folder);
};

}  // namespace vpdr::evaluation
