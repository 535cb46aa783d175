#include <gtest/gtest.h>

#include <limits>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "simulation/reference_path.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector3d;

constexpr TimestampNs kTenth = kNsPerSecond / 10;

PathPose pose(TimestampNs stamp, double x, double yaw) {
  return {stamp, {x, 0.0, 1.0}, from_euler({0.0, 0.0, yaw})};
}

TEST(ReferencePath, InterpolatesByHand) {
  const ReferencePath path({pose(0, 0.0, 0.0), pose(kTenth, 1.0, 0.4)});
  const Eigen::Isometry3d quarter = path.at(kTenth / 4);
  EXPECT_TRUE(quarter.translation().isApprox(Vector3d(0.25, 0.0, 1.0), 1e-12));
  EXPECT_NEAR(yaw_of(Eigen::Quaterniond(quarter.linear())), 0.1, 1e-12);
  EXPECT_NEAR(path.at(-5).translation().x(), 0.0, 1e-12);
  EXPECT_NEAR(path.at(2 * kTenth).translation().x(), 1.0, 1e-12);
  EXPECT_NEAR(path.length_m(), 1.0, 1e-12);
}

TEST(ReferencePath, TurnsTheShortWayForEitherSignOfAQuaternion) {
  PathPose flipped = pose(kTenth, 1.0, 0.4);
  flipped.world_from_body.coeffs() = -flipped.world_from_body.coeffs();
  const ReferencePath path({pose(0, 0.0, 0.0), flipped});
  EXPECT_NEAR(yaw_of(Eigen::Quaterniond(path.at(kTenth / 2).linear())), 0.2, 1e-12);
}

TEST(ReferencePath, LeavesBadPosesOut) {
  PathPose unknown = pose(2, 0.1, 0.0);
  unknown.position_m.x() = std::numeric_limits<double>::quiet_NaN();
  const ReferencePath path({pose(1, 0.0, 0.0), unknown, pose(1, 9.0, 0.0), pose(3, 1.0, 0.0)});
  ASSERT_EQ(path.poses().size(), 2u);
  EXPECT_NEAR(path.at(2).translation().x(), 0.5, 1e-12);
  EXPECT_THROW(ReferencePath({pose(1, 0.0, 0.0), unknown}), ConfigurationFault);
}

TEST(ReferencePath, FramesKeepToWhereItIsKnown) {
  std::vector<PathPose> poses;
  for (int k = 0; k <= 20; ++k) {
    if (k > 5 && k < 15) continue;  // nine tenths of a second are missing
    poses.push_back(pose(k * kTenth, 0.1 * k, 0.0));
  }
  const auto frames = frames_along(ReferencePath(poses), 20.0);
  for (const TimestampNs stamp : frames) {
    EXPECT_TRUE(stamp <= 5 * kTenth || stamp >= 15 * kTenth) << stamp;
  }
  EXPECT_EQ(frames.size(), 22u);
  EXPECT_EQ(frames.front(), 0);
  EXPECT_EQ(frames.back(), 20 * kTenth);
  EXPECT_TRUE(frames_along(ReferencePath(poses), 0.0).empty());
}

}  // namespace
}  // namespace vpdr::simulation
