#pragma once
// Rotations: Hamilton quaternions, body to world, world ENU (z up). Yaw 0 = east,
// counter-clockwise.
#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace vpdr {

inline constexpr double kPi = std::numbers::pi;

/// Degrees from radians, for display only.
constexpr double to_degrees(double rad) { return rad * 180.0 / kPi; }
/// Radians from degrees, at the edge only.
constexpr double to_radians(double deg) { return deg * kPi / 180.0; }

/// Angle wrapped to [-pi, pi).
double wrap_pi(double angle_rad);
/// Angle wrapped to [0, 2 pi).
double wrap_two_pi(double angle_rad);

/// Unit quaternion of the rotation vector `rad` (axis times angle); exact at and near zero.
Eigen::Quaterniond exp_rotation(const Eigen::Vector3d& rotation_vector_rad);
/// Rotation vector of the unit quaternion `q`, angle in [0, pi].
Eigen::Vector3d log_rotation(const Eigen::Quaterniond& q);

/// Intrinsic z-y-x angles (REP-103): R = Rz(yaw) Ry(pitch) Rx(roll).
struct EulerAngles {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
};
Eigen::Quaterniond from_euler(const EulerAngles& angles);
/// Pitch in [-pi/2, pi/2]; at +-pi/2 roll is set to zero.
EulerAngles to_euler(const Eigen::Quaterniond& world_from_body);

/// Yaw of the body's forward axis, [-pi, pi).
double yaw_of(const Eigen::Quaterniond& world_from_body);

/// Compass view of a yaw: north 0, clockwise, [0, 2 pi). Its own inverse up to wrapping.
double azimuth_from_yaw(double yaw_rad);
/// Yaw of a compass azimuth, [-pi, pi).
double yaw_from_azimuth(double azimuth_rad);

/// Matrix S with S b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

}  // namespace vpdr
