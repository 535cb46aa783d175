#pragma once
// The AHRS paper's angles as printed (S3.4: 3, 4, 5), kept as views of a quaternion w x y z. They
// are not vpdr's roll, pitch and yaw (core/rotation.hpp): the paper's names fit a board mounted
// otherwise. (3) is the turn about x in the z-y-x order although it is called heading, (5) is the
// turn about z although it is called roll and its sign is the other way, and (4) is the middle
// angle of the order y-x-z, another than (3)'s. atan is taken with two arguments, so that every
// quadrant comes out.
#include <Eigen/Geometry>
#include <cmath>

namespace vpdr::pdr {

/// (3): "heading" = atan(2 (q2 q3 + q0 q1) / (q0^2 - q1^2 - q2^2 + q3^2)), rad, [-pi, pi].
inline double paper_heading(const Eigen::Quaterniond& q) {
  return std::atan2(2.0 * (q.y() * q.z() + q.w() * q.x()),
                    q.w() * q.w() - q.x() * q.x() - q.y() * q.y() + q.z() * q.z());
}

/// (4): "pitch" = asin(-2 (q2 q3 - q0 q1)), rad, [-pi/2, pi/2].
inline double paper_pitch(const Eigen::Quaterniond& q) {
  const double sine = -2.0 * (q.y() * q.z() - q.w() * q.x());
  return std::asin(sine > 1.0 ? 1.0 : (sine < -1.0 ? -1.0 : sine));
}

/// (5): "roll" = atan(2 (q1 q2 - q0 q3) / (q0^2 + q1^2 - q2^2 - q3^2)), rad, [-pi, pi].
inline double paper_roll(const Eigen::Quaterniond& q) {
  return std::atan2(2.0 * (q.x() * q.y() - q.w() * q.z()),
                    q.w() * q.w() + q.x() * q.x() - q.y() * q.y() - q.z() * q.z());
}

}  // namespace vpdr::pdr
