#include "vision/core/attitude_history.hpp"

#include <gtest/gtest.h>

#include "core/rotation.hpp"

namespace vpdr::vision {
namespace {

using Answer = AttitudeHistory::Answer;
constexpr TimestampNs kMs = 1'000'000;

AttitudeEstimate attitude(TimestampNs stamp_ns, double yaw, double yaw_rate) {
  AttitudeEstimate a;
  a.stamp_ns = stamp_ns;
  a.world_from_body = from_euler({0.0, 0.0, yaw});
  a.covariance_rad2.diagonal() << 9e-4, 4e-4, 1.0;
  a.angular_velocity_radps = {0.0, 0.0, yaw_rate};
  return a;
}

TEST(AttitudeHistory, AFrameWaitsForTheEstimateAfterIt) {
  AttitudeHistory history;
  AttitudePrior prior;
  EXPECT_EQ(history.at(0, prior), Answer::kNotYet);
  EXPECT_FALSE(history.newest_ns());
  history.push(attitude(10 * kMs, 0.0, 0.0));
  EXPECT_EQ(history.at(11 * kMs, prior), Answer::kNotYet);
  EXPECT_EQ(history.at(10 * kMs, prior), Answer::kKnown);
  EXPECT_EQ(history.at(9 * kMs, prior), Answer::kUnknown);
  EXPECT_EQ(*history.newest_ns(), 10 * kMs);
}

TEST(AttitudeHistory, InterpolatesByHand) {
  AttitudeHistory history({.mounting_sigma_rad = 0.04, .max_gap_s = 0.1});
  history.push(attitude(0, 0.2, 1.0));
  history.push(attitude(10 * kMs, 0.3, 3.0));
  history.push(attitude(20 * kMs, 0.4, 3.0));
  AttitudePrior prior;
  ASSERT_EQ(history.at(12'500'000, prior), Answer::kKnown);
  EXPECT_NEAR(yaw_of(prior.world_from_body), 0.325, 1e-12);
  // Turned (1 + 3) / 2 * 10 ms, then a quarter of 3 * 10 ms.
  ASSERT_TRUE(prior.turn);
  EXPECT_NEAR(prior.turn->rad, 0.02 + 0.0075, 1e-12);
  // Larger tilt sigma 0.03 with the mounting's 0.04.
  EXPECT_NEAR(prior.inclination_sigma_rad, 0.05, 1e-12);
}

TEST(AttitudeHistory, TheTurnIsAboutTheVerticalWhateverTheAttitude) {
  AttitudeHistory history;
  const Eigen::Quaterniond lying = from_euler({0.5 * kPi, 0.0, 0.0});
  for (int i = 0; i <= 100; ++i) {
    AttitudeEstimate a = attitude(i * 10 * kMs, 0.0, 0.0);
    a.world_from_body = from_euler({0.0, 0.0, 0.01 * i}) * lying;
    a.angular_velocity_radps = lying.conjugate() * Eigen::Vector3d(0.0, 0.0, 1.0);
    history.push(a);
  }
  AttitudePrior prior;
  ASSERT_EQ(history.at(1000 * kMs, prior), Answer::kKnown);
  EXPECT_NEAR(prior.turn->rad, 1.0, 1e-12);
}

TEST(AttitudeHistory, AGapIsNotInterpolatedAndBeginsANewEpoch) {
  AttitudeHistory history;
  history.push(attitude(0, 0.0, 1.0));
  history.push(attitude(500 * kMs, 1.0, 1.0));
  AttitudePrior prior;
  EXPECT_EQ(history.at(250 * kMs, prior), Answer::kUnknown);
  ASSERT_EQ(history.at(0, prior), Answer::kKnown);
  EXPECT_EQ(prior.turn->epoch, 0U);
  ASSERT_EQ(history.at(500 * kMs, prior), Answer::kKnown);
  EXPECT_EQ(prior.turn->epoch, 1U);
}

TEST(AttitudeHistory, LeavesOutWhatIsNotLaterAndForgetsTheOldest) {
  AttitudeHistory history;
  history.push(attitude(5 * kMs, 0.5, 0.0));
  history.push(attitude(5 * kMs, 0.9, 0.0));
  history.push(attitude(4 * kMs, 0.9, 0.0));
  AttitudePrior prior;
  ASSERT_EQ(history.at(5 * kMs, prior), Answer::kKnown);
  EXPECT_NEAR(yaw_of(prior.world_from_body), 0.5, 1e-12);
  for (int i = 6; i < 3000; ++i) history.push(attitude(i * kMs, 0.0, 0.0));
  EXPECT_EQ(history.at(5 * kMs, prior), Answer::kUnknown);
  EXPECT_EQ(history.at(2500 * kMs, prior), Answer::kKnown);
}

}  // namespace
}  // namespace vpdr::vision
