#include <gtest/gtest.h>

#include "core/rotation.hpp"
#include "core/time.hpp"

namespace vpdr {
namespace {

TEST(Wrap, KeepsHalfOpenIntervals) {
  EXPECT_DOUBLE_EQ(wrap_pi(kPi), -kPi);
  EXPECT_DOUBLE_EQ(wrap_pi(-kPi), -kPi);
  EXPECT_NEAR(wrap_pi(5.0 * kPi / 2.0), kPi / 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(wrap_two_pi(2.0 * kPi), 0.0);
  EXPECT_LT(wrap_two_pi(-1e-17), 2.0 * kPi);
  EXPECT_NEAR(wrap_two_pi(-kPi / 2.0), 1.5 * kPi, 1e-12);
}

TEST(Rotation, ExpAndLogAreInverse) {
  for (double angle : {0.0, 1e-12, 1e-7, 1e-3, 1.0, 3.1}) {
    const Eigen::Vector3d v = angle * Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
    EXPECT_LT((log_rotation(exp_rotation(v)) - v).norm(), 1e-12) << angle;
    EXPECT_NEAR(exp_rotation(v).norm(), 1.0, 1e-14);
  }
}

TEST(Rotation, QuarterTurnAboutUpTakesForwardToLeft) {
  const Eigen::Quaterniond q = exp_rotation({0.0, 0.0, kPi / 2.0});
  EXPECT_LT((q * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_NEAR(yaw_of(q), kPi / 2.0, 1e-15);
}

TEST(Rotation, EulerAnglesRoundTrip) {
  const EulerAngles in{0.3, -1.1, 2.5};
  const EulerAngles out = to_euler(from_euler(in));
  EXPECT_NEAR(out.roll_rad, in.roll_rad, 1e-12);
  EXPECT_NEAR(out.pitch_rad, in.pitch_rad, 1e-12);
  EXPECT_NEAR(out.yaw_rad, in.yaw_rad, 1e-12);
}

TEST(Rotation, EulerAnglesAtTheSingularityDescribeTheSameRotation) {
  const Eigen::Quaterniond q = from_euler({0.4, kPi / 2.0, 1.0});
  EXPECT_LT(q.angularDistance(from_euler(to_euler(q))), 1e-7);
}

TEST(Azimuth, NorthIsZeroAndClockwise) {
  EXPECT_NEAR(azimuth_from_yaw(kPi / 2.0), 0.0, 1e-15);   // north
  EXPECT_NEAR(azimuth_from_yaw(0.0), kPi / 2.0, 1e-15);   // east
  EXPECT_NEAR(azimuth_from_yaw(-kPi / 2.0), kPi, 1e-15);  // south
  EXPECT_NEAR(azimuth_from_yaw(kPi), 1.5 * kPi, 1e-15);   // west
  for (double yaw = -3.0; yaw < 3.0; yaw += 0.5) {
    EXPECT_NEAR(yaw_from_azimuth(azimuth_from_yaw(yaw)), yaw, 1e-12);
  }
}

TEST(Skew, IsTheCrossProduct) {
  const Eigen::Vector3d a(1, 2, 3);
  const Eigen::Vector3d b(-4, 5, 6);
  EXPECT_LT((skew(a) * b - a.cross(b)).norm(), 1e-15);
}

TEST(Time, ConvertsBothWays) {
  EXPECT_EQ(to_ns(1.5), 1'500'000'000);
  EXPECT_EQ(to_ns(-0.25), -250'000'000);
  EXPECT_DOUBLE_EQ(to_seconds(2'500'000'000), 2.5);
}

}  // namespace
}  // namespace vpdr
