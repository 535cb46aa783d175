#include <gtest/gtest.h>

#include "core/rotation.hpp"
#include "vision/core/odometry/odometry_chain.hpp"

namespace vpdr::vision {
namespace {

using Eigen::Vector3d;

MotionEstimate ahead(TimestampNs stamp_ns, double metres, double yaw_sigma) {
  MotionEstimate m;
  m.stamp_ns = stamp_ns;
  m.translation_m = {metres, 0.0, 0.0};
  m.covariance(5, 5) = yaw_sigma * yaw_sigma;
  return m;
}

TEST(OdometryChain, GoesWhereTheMotionsLead) {
  OdometryChain chain;
  chain.start(0, from_euler({0, 0, 0.5 * kPi}), 0.01);
  chain.advance(ahead(kNsPerSecond, 2.0, 0.0), 0.0);
  MotionEstimate left = ahead(2 * kNsPerSecond, 0.0, 0.0);
  left.rotation = from_euler({0, 0, 0.5 * kPi});
  chain.advance(left, 0.0);
  chain.advance(ahead(3 * kNsPerSecond, 1.0, 0.0), 0.0);
  EXPECT_LT((chain.pose().position_m - Vector3d(-1.0, 2.0, 0.0)).norm(), 1e-9);
  EXPECT_NEAR(chain.pose().speed_mps, 1.0, 1e-9);
  EXPECT_EQ(chain.pose().stamp_ns, 3 * kNsPerSecond);
}

TEST(OdometryChain, AYawErrorBecomesASidewaysError) {
  OdometryChain chain;
  chain.start(0, Eigen::Quaterniond::Identity(), 0.0);
  chain.advance(ahead(1, 1.0, 0.02), 0.0);
  chain.advance(ahead(2, 3.0, 0.0), 0.0);
  EXPECT_NEAR(std::sqrt(chain.pose().covariance(5, 5)), 0.02, 1e-12);
  EXPECT_NEAR(std::sqrt(chain.pose().covariance(1, 1)), 3.0 * 0.02, 1e-12);
  EXPECT_NEAR(chain.pose().covariance(0, 0), 0.0, 1e-12);
}

TEST(OdometryChain, AWrongUnitAddsUpAlongTheWay) {
  OdometryChain chain;
  chain.start(0, Eigen::Quaterniond::Identity(), 0.0);
  for (int i = 1; i <= 10; ++i) chain.advance(ahead(i, 1.0, 0.0), 0.05);
  EXPECT_NEAR(std::sqrt(chain.pose().covariance(0, 0)), 10.0 * 0.05, 1e-9);
  // A better unit leaves what is behind as uncertain as it was.
  chain.advance(ahead(11, 1.0, 0.0), 0.01);
  EXPECT_NEAR(std::sqrt(chain.pose().covariance(0, 0)), 0.5, 0.03);
}

TEST(OdometryChain, TheVerticalHoldsTheTilt) {
  OdometryChain chain;
  chain.start(0, from_euler({0.1, -0.05, 0.7}), 0.1);
  const Vector3d up_body = from_euler({0.02, 0.01, 0.7}).conjugate() * Vector3d::UnitZ();
  for (int i = 1; i <= 400; ++i) {
    MotionEstimate m = ahead(i * kNsPerSecond / 20, 0.0, 0.0);
    m.covariance(3, 3) = m.covariance(4, 4) = 1e-6;
    chain.advance(m, 0.0);
    chain.level(up_body, 0.01, 0.05);
  }
  const EulerAngles angles = to_euler(chain.pose().world_from_body);
  EXPECT_NEAR(angles.roll_rad, 0.02, 2e-3);
  EXPECT_NEAR(angles.pitch_rad, 0.01, 2e-3);
  EXPECT_LT(chain.pose().covariance(3, 3), 0.01 * 0.01);
}

}  // namespace
}  // namespace vpdr::vision
