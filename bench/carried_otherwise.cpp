#include "bench/carried_otherwise.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/time.hpp"

namespace vpdr::bench {

void hold_across(dataset::Recording& recording, double angle_rad) {
  const Eigen::AngleAxisd back(-angle_rad, Eigen::Vector3d::UnitZ());
  for (ImuSample& sample : recording.imu) {
    sample.specific_force_mps2 = back * sample.specific_force_mps2;
    sample.angular_velocity_radps = back * sample.angular_velocity_radps;
  }
  for (MagSample& sample : recording.mag) sample.field_ut = back * sample.field_ut;
}

void turn_over(dataset::Recording& recording, double angle_rad) {
  if (recording.imu.empty()) return;
  constexpr double kDuration_s = 0.8;
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
  const TimestampNs begin_ns = recording.imu[recording.imu.size() / 2].stamp_ns;
  const auto share = [begin_ns](TimestampNs stamp_ns) {
    return std::clamp(to_seconds(stamp_ns - begin_ns) / kDuration_s, 0.0, 1.0);
  };
  // Smoothly: 3 x^2 - 2 x^3 of the angle, and its derivative as a rate.
  const auto back = [&](TimestampNs stamp_ns) {
    const double x = share(stamp_ns);
    return Eigen::AngleAxisd(-angle_rad * x * x * (3.0 - 2.0 * x), axis);
  };
  for (ImuSample& sample : recording.imu) {
    const double x = share(sample.stamp_ns);
    const double rate_radps = angle_rad * 6.0 * x * (1.0 - x) / kDuration_s;
    sample.specific_force_mps2 = back(sample.stamp_ns) * sample.specific_force_mps2;
    sample.angular_velocity_radps =
        back(sample.stamp_ns) * sample.angular_velocity_radps + rate_radps * axis;
  }
  for (MagSample& sample : recording.mag) {
    sample.field_ut = back(sample.stamp_ns) * sample.field_ut;
  }
}

}  // namespace vpdr::bench
