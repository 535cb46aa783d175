#pragma once
// Inertial samples for a path that has none: the path becomes a smooth curve with exact
// derivatives, from which an accelerometer and a gyroscope with their errors are read.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/samples.hpp"
#include "simulation/reference_path.hpp"
#include "simulation/sensor_errors.hpp"

namespace vpdr::simulation {

struct InertialPath {
  ReferencePath path;          ///< the curve: the truth of the samples, of the sensor
  std::vector<ImuSample> imu;  ///< sensor axes
};

struct PathImuOptions {
  double rate_hz = 200.0;
  double control_interval_s = 0.05;  ///< of the curve: quicker shaking than that is lost
  SensorErrors errors;
  std::uint64_t seed = 1;
};

/// `body_from_sensor`: the mount. Throws ConfigurationFault where the body stands on its head (its
/// forward axis within 10 degrees of the vertical), which the curve's angles cannot tell.
InertialPath imu_along(const ReferencePath& path, const Eigen::Matrix3d& body_from_sensor,
                       const PathImuOptions& options = {});

}  // namespace vpdr::simulation
