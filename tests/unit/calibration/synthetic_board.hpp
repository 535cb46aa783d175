#pragma once
// A board that is laid down in one pose after the other and turned in between, as its sensors see
// it: true streams at 100 Hz, to which a test adds the faults it is about.
#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "core/sensor_streams.hpp"

namespace vpdr::calibration::testing {

constexpr double kRateHz = 100.0;

/// What a place is like: gravity up, a field of 48 uT that dips by 62 degrees to the north.
inline Eigen::Vector3d true_field_ut() {
  const double dip = to_radians(62.0);
  return 48.0 * Eigen::Vector3d(0.0, std::cos(dip), -std::sin(dip));
}

/// World from board, smoothly from pose to pose: each is held for `rest_s`.
inline std::vector<Eigen::Quaterniond> attitudes(const std::vector<Eigen::Quaterniond>& poses,
                                                 double rest_s, double turn_s) {
  std::vector<Eigen::Quaterniond> out;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    for (int k = 0; k < static_cast<int>(rest_s * kRateHz); ++k) out.push_back(poses[i]);
    if (i + 1 == poses.size()) break;
    const int count = static_cast<int>(turn_s * kRateHz);
    for (int k = 0; k < count; ++k) {
      const double share = 0.5 - 0.5 * std::cos(kPi * k / count);
      out.push_back(poses[i].slerp(share, poses[i + 1]));
    }
  }
  return out;
}

/// True streams along `attitudes`, with white noise.
inline SensorStreams true_streams(const std::vector<Eigen::Quaterniond>& attitudes,
                                  double force_noise_mps2 = 0.02, double rate_noise_radps = 1e-3,
                                  double field_noise_ut = 0.2, unsigned seed = 1) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal;
  const auto noise = [&](double sigma) {
    return Eigen::Vector3d(sigma * normal(engine), sigma * normal(engine), sigma * normal(engine));
  };
  SensorStreams out;
  for (std::size_t i = 0; i < attitudes.size(); ++i) {
    const TimestampNs stamp = to_ns(static_cast<double>(i) / kRateHz);
    const Eigen::Quaterniond board_from_world = attitudes[i].conjugate();
    // The rate belongs to the interval about the sample, as a sensor's does.
    const Eigen::Quaterniond& before = attitudes[i > 0 ? i - 1 : i];
    const Eigen::Quaterniond& after = attitudes[i + 1 < attitudes.size() ? i + 1 : i];
    const Eigen::Vector3d rate = log_rotation(before.conjugate() * after) * kRateHz / 2.0;
    out.force_mps2.push_back(
        {stamp, board_from_world * Eigen::Vector3d(0, 0, kGravityMps2) + noise(force_noise_mps2)});
    out.rate_radps.push_back({stamp, rate + noise(rate_noise_radps)});
    out.field_ut.push_back({stamp, board_from_world * true_field_ut() + noise(field_noise_ut)});
  }
  return out;
}

/// A pose in which the board's `up` points up, turned about it by `yaw_rad`.
inline Eigen::Quaterniond pose(const Eigen::Vector3d& up, double yaw_rad = 0.0) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ());
}

/// The six sides and four edges.
inline std::vector<Eigen::Quaterniond> ten_poses() {
  using V = Eigen::Vector3d;
  return {pose(V(0, 0, 1)),  pose(V(1, 0, 0)),  pose(V(0, 1, 0)), pose(V(0, 0, -1)),
          pose(V(0, -1, 0)), pose(V(-1, 0, 0)), pose(V(1, 1, 0)), pose(V(1, 0, 1)),
          pose(V(0, -1, 1)), pose(V(-1, 0, 1))};
}

/// Every way about: a path through poses spread over the sphere, with turns about the vertical.
inline std::vector<Eigen::Quaterniond> all_ways(int count = 60) {
  std::vector<Eigen::Quaterniond> poses;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = 2.39996 * i;
    const double r = std::sqrt(1.0 - z * z);
    poses.push_back(pose({r * std::cos(angle), r * std::sin(angle), z}, 0.7 * i));
  }
  return poses;
}

}  // namespace vpdr::calibration::testing
