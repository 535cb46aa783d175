#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "simulation/path_imu.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr TimestampNs kStart = 3 * kNsPerSecond;

/// Sensor from body: the sensor's -y points forward, its z up.
Matrix3d mount() {
  Matrix3d body_from_sensor;
  body_from_sensor << 0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  return body_from_sensor;
}

/// Twice round a circle of 2 m in 20 s, the body ahead, nodding; poses 20 a second.
ReferencePath circle() {
  std::vector<PathPose> poses;
  for (int k = 0; k <= 400; ++k) {
    const double angle = 4.0 * kPi * k / 400.0;
    const Eigen::Quaterniond body = from_euler(
        {0.1 * std::sin(angle), 0.2 * std::cos(2.0 * angle), wrap_pi(angle + 0.5 * kPi)});
    poses.push_back({kStart + k * 50'000'000LL,
                     {2.0 * std::cos(angle), 2.0 * std::sin(angle), 1.3},
                     body * Eigen::Quaterniond(mount())});
  }
  return ReferencePath(poses);
}

PathImuOptions exact() {
  PathImuOptions options;
  options.errors = SensorErrors::none();
  return options;
}

TEST(PathImu, SamplesIntegrateToTheCurve) {
  const InertialPath made = imu_along(circle(), mount(), exact());
  ASSERT_GT(made.imu.size(), 3900u);
  Eigen::Quaterniond q(made.path.at(made.imu.front().stamp_ns).linear());
  Vector3d position = made.path.at(made.imu.front().stamp_ns).translation();
  const auto& poses = made.path.poses();
  Vector3d velocity = (poses[1].position_m - poses[0].position_m) / 0.005;
  const Vector3d gravity(0.0, 0.0, kGravityMps2);
  // Half a step back: the first difference is the velocity half-way.
  velocity -= 0.0025 * (q * made.imu[0].specific_force_mps2 - gravity);
  for (std::size_t i = 1; i < made.imu.size(); ++i) {
    const ImuSample &a = made.imu[i - 1], &b = made.imu[i];
    const Vector3d before = q * a.specific_force_mps2 - gravity;
    q = (q * exp_rotation(0.0025 * (a.angular_velocity_radps + b.angular_velocity_radps)))
            .normalized();
    const Vector3d after = q * b.specific_force_mps2 - gravity;
    position += 0.005 * velocity + 0.00000625 * (before + after);
    velocity += 0.0025 * (before + after);
  }
  const Eigen::Isometry3d end = made.path.at(made.imu.back().stamp_ns);
  EXPECT_LT(to_degrees(Eigen::Quaterniond(end.linear()).angularDistance(q)), 0.05);
  EXPECT_LT((end.translation() - position).norm(), 0.05);
}

TEST(PathImu, TheCurveKeepsToThePath) {
  const ReferencePath path = circle();
  const InertialPath made = imu_along(path, mount(), exact());
  for (const PathPose& pose : made.path.poses()) {
    const Eigen::Isometry3d there = path.at(pose.stamp_ns);
    EXPECT_LT((pose.position_m - there.translation()).norm(), 0.003);
    EXPECT_LT(to_degrees(Eigen::Quaterniond(there.linear()).angularDistance(pose.world_from_body)),
              0.3);
  }
  EXPECT_EQ(made.path.begin_ns(), path.begin_ns());
}

TEST(PathImu, ByHand) {
  // Level round the circle: 4 pi / 20 s; towards the middle v^2 / r = 0.79, which is the body's
  // left, the sensor's +x; the body's up is the sensor's z.
  std::vector<PathPose> poses;
  for (int k = 0; k <= 400; ++k) {
    const double angle = 4.0 * kPi * k / 400.0;
    poses.push_back({kStart + k * 50'000'000LL,
                     {2.0 * std::cos(angle), 2.0 * std::sin(angle), 1.3},
                     from_euler({0.0, 0.0, angle + 0.5 * kPi}) * Eigen::Quaterniond(mount())});
  }
  const InertialPath made = imu_along(ReferencePath(poses), mount(), exact());
  const ImuSample& middle = made.imu[2000];
  const double rate = 4.0 * kPi / 20.0;
  EXPECT_NEAR((middle.angular_velocity_radps - Vector3d(0.0, 0.0, rate)).norm(), 0.0, 1e-3);
  EXPECT_NEAR((middle.specific_force_mps2 - Vector3d(2.0 * rate * rate, 0.0, kGravityMps2)).norm(),
              0.0, 0.01);
}

TEST(PathImu, ErrorsComeFromTheSeed) {
  PathImuOptions options;
  const InertialPath a = imu_along(circle(), mount(), options);
  const InertialPath again = imu_along(circle(), mount(), options);
  options.seed = 2;
  const InertialPath b = imu_along(circle(), mount(), options);
  EXPECT_EQ(a.imu[77].angular_velocity_radps, again.imu[77].angular_velocity_radps);
  EXPECT_NE(a.imu[77].angular_velocity_radps, b.imu[77].angular_velocity_radps);
}

TEST(PathImu, RefusesABodyOnItsHead) {
  // With the sensor's forward axis taken for up, the body looks along the vertical.
  Matrix3d wrong;
  wrong << 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0;
  EXPECT_THROW(imu_along(circle(), wrong, exact()), ConfigurationFault);
}

}  // namespace
}  // namespace vpdr::simulation
