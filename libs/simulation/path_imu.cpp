#include "simulation/path_imu.hpp"

#include <cmath>
#include <utility>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "simulation/curve.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSteepestRad = to_radians(80.0);

/// The path of the body as the controls of a curve that begins at its first pose.
std::vector<MotionSpline::Control> controls_of(const ReferencePath& path,
                                               const Matrix3d& body_from_sensor,
                                               double interval_s) {
  std::vector<MotionSpline::Control> controls;
  const int last = static_cast<int>(to_seconds(path.end_ns() - path.begin_ns()) / interval_s);
  if (last < 1) throw ConfigurationFault("path: too short for inertial samples");
  double yaw = 0.0;
  for (int k = 0; k <= last; ++k) {
    const Eigen::Isometry3d sensor = path.at(path.begin_ns() + to_ns(k * interval_s));
    const Eigen::Quaterniond body(Matrix3d(sensor.linear() * body_from_sensor.transpose()));
    const EulerAngles angles = to_euler(body);
    if (std::abs(angles.pitch_rad) > kSteepestRad) {
      throw ConfigurationFault(
          "path: the body points straight up or down; name the axes of its sensor with --mount");
    }
    yaw = controls.empty() ? angles.yaw_rad : yaw + wrap_pi(angles.yaw_rad - yaw);
    const double roll = controls.empty()
                            ? angles.roll_rad
                            : controls.back()[3] + wrap_pi(angles.roll_rad - controls.back()[3]);
    MotionSpline::Control control;
    control << sensor.translation(), roll, angles.pitch_rad, yaw;
    controls.push_back(control);
  }
  // One more at each end, so that the curve sets off and arrives in motion.
  const auto end = controls.size() - 1;
  controls.push_back(2.0 * controls[end] - controls[end - 1]);
  controls.insert(controls.begin(), 2.0 * controls[0] - controls[1]);
  return controls;
}

}  // namespace

InertialPath imu_along(const ReferencePath& path, const Matrix3d& body_from_sensor,
                       const PathImuOptions& options) {
  if (!(options.rate_hz >= 5.0 && options.rate_hz <= 2000.0)) {
    throw ConfigurationFault("path: the rate of inertial samples must be 5 to 2000 Hz");
  }
  const MotionSpline motion(options.control_interval_s,
                            controls_of(path, body_from_sensor, options.control_interval_s));
  TriadSensor accelerometer(options.errors.accelerometer, options.rate_hz,
                            Random(options.seed, "acc"));
  TriadSensor gyroscope(options.errors.gyroscope, options.rate_hz, Random(options.seed, "gyro"));
  const Matrix3d sensor_from_body = body_from_sensor.transpose();
  const Eigen::Quaterniond body_quaternion(body_from_sensor);
  std::vector<PathPose> poses;
  std::vector<ImuSample> imu;
  const double interval_s = 1.0 / options.rate_hz;
  for (int k = 0; k * interval_s <= motion.duration_s(); ++k) {
    const MotionState state = motion.at(k * interval_s);
    const TimestampNs stamp = path.begin_ns() + to_ns(k * interval_s);
    poses.push_back({stamp, state.position_m, state.world_from_body * body_quaternion});
    ImuSample sample;
    sample.stamp_ns = stamp;
    const double since_s = k > 0 ? interval_s : 0.0;
    sample.specific_force_mps2 =
        accelerometer.read(sensor_from_body * state.specific_force_mps2(), since_s);
    sample.angular_velocity_radps =
        gyroscope.read(sensor_from_body * state.angular_velocity_radps, since_s);
    imu.push_back(sample);
  }
  return {ReferencePath(poses), std::move(imu)};
}

}  // namespace vpdr::simulation
