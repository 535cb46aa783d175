#pragma once
// Where the board lay still: the poses of an accelerometer's calibration and the places where a
// gyroscope reads its bias.
#include <vector>

#include "core/sensor_streams.hpp"

namespace vpdr::calibration {

/// A board on a table: the noise of MEMS sensors with some room. A hand never holds so still.
struct RestConfig {
  double window_s = 0.25;
  double force_sigma_mps2 = 0.12;  ///< largest deviation within a window, all axes together
  double force_step_mps2 = 0.1;    ///< largest change of the mean from one window to the next
  double rate_sigma_radps = 0.03;  ///< the same for the gyroscope, where there is one
  double rate_step_radps = 0.02;
  double min_duration_s = 0.75;
};

/// One rest.
struct Rest {
  TimestampNs begin_ns = 0;
  TimestampNs end_ns = 0;  ///< exclusive
  Eigen::Vector3d force_mps2 = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_radps = Eigen::Vector3d::Zero();  ///< zero without a gyroscope
  double force_sigma_mps2 = 0.0;                         ///< of a sample, all axes together
  std::size_t samples = 0;                               ///< of the accelerometer
  [[nodiscard]] double duration_s() const { return to_seconds(end_ns - begin_ns); }
};

/// The rests of a recording, oldest first. Of the gyroscope alone where there is no accelerometer.
std::vector<Rest> find_rests(const SensorStreams& streams, const RestConfig& config = {});

/// For each rest the number of its pose, 0 for the first: rests of one pose differ in the direction
/// of the force by less than `angle_rad`.
std::vector<std::size_t> number_poses(const std::vector<Rest>& rests, double angle_rad = 0.1);

}  // namespace vpdr::calibration
