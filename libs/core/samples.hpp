#pragma once
// What the board measures. Axes: the body's, forward-left-up, once imu_gateway has turned them.
#include <Eigen/Core>
#include <optional>

#include "core/time.hpp"

namespace vpdr {

/// Standard gravity, m/s^2.
inline constexpr double kGravityMps2 = 9.80665;

/// One inertial sample.
struct ImuSample {
  TimestampNs stamp_ns = 0;
  Eigen::Vector3d specific_force_mps2 = Eigen::Vector3d::Zero();  ///< +9.8 on the axis that is up
  Eigen::Vector3d angular_velocity_radps = Eigen::Vector3d::Zero();  ///< zero where absent
  bool has_angular_velocity = true;  ///< false for a board without a gyroscope
};

/// One magnetometer sample, microtesla.
struct MagSample {
  TimestampNs stamp_ns = 0;
  Eigen::Vector3d field_ut = Eigen::Vector3d::Zero();
};

/// One barometer sample, pascal.
struct PressureSample {
  TimestampNs stamp_ns = 0;
  double pressure_pa = 0.0;
};

}  // namespace vpdr
