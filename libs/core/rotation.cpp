#include "core/rotation.hpp"

#include <algorithm>

namespace vpdr {

double wrap_two_pi(double angle_rad) {
  const double wrapped = std::fmod(angle_rad, 2.0 * kPi);
  const double positive = wrapped < 0.0 ? wrapped + 2.0 * kPi : wrapped;
  return positive >= 2.0 * kPi ? 0.0 : positive;
}

double wrap_pi(double angle_rad) {
  const double shifted = wrap_two_pi(angle_rad + kPi) - kPi;
  return shifted >= kPi ? -kPi : shifted;
}

Eigen::Quaterniond exp_rotation(const Eigen::Vector3d& rotation_vector_rad) {
  const double angle = rotation_vector_rad.norm();
  // sin(x/2)/x by its series where the quotient loses digits.
  const double factor = angle < 1e-6 ? 0.5 - angle * angle / 48.0 : std::sin(0.5 * angle) / angle;
  const Eigen::Vector3d v = factor * rotation_vector_rad;
  return {std::cos(0.5 * angle), v.x(), v.y(), v.z()};
}

Eigen::Vector3d log_rotation(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d v = sign * q.vec();
  const double sine = v.norm();
  const double angle = 2.0 * std::atan2(sine, sign * q.w());
  return sine < 1e-9 ? Eigen::Vector3d(2.0 * v) : Eigen::Vector3d(v * (angle / sine));
}

Eigen::Quaterniond from_euler(const EulerAngles& angles) {
  return Eigen::AngleAxisd(angles.yaw_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(angles.pitch_rad, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(angles.roll_rad, Eigen::Vector3d::UnitX());
}

EulerAngles to_euler(const Eigen::Quaterniond& world_from_body) {
  const Eigen::Matrix3d r = world_from_body.toRotationMatrix();
  const double sine = std::clamp(-r(2, 0), -1.0, 1.0);
  EulerAngles out;
  out.pitch_rad = std::asin(sine);
  if (std::abs(sine) > 1.0 - 1e-12) {
    out.yaw_rad = std::atan2(-r(0, 1), r(1, 1));
    return out;
  }
  out.roll_rad = std::atan2(r(2, 1), r(2, 2));
  out.yaw_rad = std::atan2(r(1, 0), r(0, 0));
  return out;
}

double yaw_of(const Eigen::Quaterniond& q) {
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()),
                    1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

double azimuth_from_yaw(double yaw_rad) { return wrap_two_pi(0.5 * kPi - yaw_rad); }

double yaw_from_azimuth(double azimuth_rad) { return wrap_pi(0.5 * kPi - azimuth_rad); }

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d s;
  s << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return s;
}

}  // namespace vpdr
