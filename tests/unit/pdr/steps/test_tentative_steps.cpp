#include <gtest/gtest.h>

#include "core/rotation.hpp"
#include "pdr/core/steps/tentative_steps.hpp"

namespace vpdr::pdr {
namespace {

StepEvent tentative(TimestampNs stamp_ns, double length_m, double yaw_rad, double probability) {
  StepEvent step;
  step.stamp_ns = stamp_ns;
  step.length_m = length_m;
  step.yaw_rad = yaw_rad;
  step.status = StepStatus::kTentative;
  step.probability = probability;
  return step;
}

TEST(TentativeSteps, AreWorthTheirProbability) {
  TentativeSteps steps;
  EXPECT_TRUE(steps.displacement_m(0.0).isZero());
  EXPECT_TRUE(steps.covariance_m2(0.0).isZero());
  steps.add(tentative(1, 0.8, 0.0, 0.5));
  steps.add(tentative(2, 0.6, 0.5 * kPi, 0.9));
  // 0.5 x 0.8 east, 0.9 x 0.6 north.
  EXPECT_TRUE(steps.displacement_m(0.0).isApprox(Eigen::Vector2d(0.40, 0.54), 1e-12));
  // sqrt(p (1 - p)) l: 0.5 x 0.8 = 0.4 and 0.3 x 0.6 = 0.18, and both or none.
  Eigen::Matrix2d expected;
  expected << 0.16, 0.072, 0.072, 0.0324;
  EXPECT_TRUE(steps.covariance_m2(0.0).isApprox(expected, 1e-12));
}

TEST(TentativeSteps, OwnNoiseCountsAsFarAsTheStepDoes) {
  TentativeSteps steps;
  StepEvent step = tentative(1, 0.0, 0.0, 0.5);
  step.length_sigma_m = 0.2;
  steps.add(step);
  EXPECT_NEAR(steps.covariance_m2(0.0)(0, 0), 0.5 * 0.04, 1e-15);
}

TEST(TentativeSteps, TheLastWordTakesThemAway) {
  TentativeSteps steps;
  for (TimestampNs stamp = 1; stamp <= 3; ++stamp) steps.add(tentative(stamp, 1.0, 0.0, 0.5));
  const auto taken = steps.take(2);
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->stamp_ns, 2);
  EXPECT_FALSE(steps.take(2));
  EXPECT_EQ(steps.size(), 2U);
  EXPECT_NEAR(steps.displacement_m(0.0).x(), 1.0, 1e-15);
}

TEST(TentativeSteps, TurnWithTheZeroOfYaw) {
  TentativeSteps steps;
  StepEvent step = tentative(1, 1.0, 0.0, 1.0);
  step.yaw_revision_rad = 0.1;
  steps.add(step);
  EXPECT_TRUE(steps.displacement_m(0.1 + 0.5 * kPi).isApprox(Eigen::Vector2d(0.0, 1.0), 1e-12));
}

TEST(TentativeSteps, KeepsTheNewestEight) {
  TentativeSteps steps;
  for (TimestampNs stamp = 1; stamp <= 20; ++stamp) steps.add(tentative(stamp, 1.0, 0.0, 1.0));
  EXPECT_EQ(steps.size(), 8U);
  EXPECT_FALSE(steps.take(12));
  EXPECT_TRUE(steps.take(13));
}

}  // namespace
}  // namespace vpdr::pdr
