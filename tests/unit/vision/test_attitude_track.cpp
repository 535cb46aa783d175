#include <gtest/gtest.h>

#include "core/rotation.hpp"
#include "vision/core/attitude_track.hpp"

namespace vpdr::vision {
namespace {

constexpr TimestampNs kMs = 1'000'000;

AttitudeEstimate attitude(TimestampNs stamp_ns, double yaw, double yaw_rate) {
  AttitudeEstimate a;
  a.stamp_ns = stamp_ns;
  a.world_from_body = from_euler({0.0, 0.0, yaw});
  a.covariance_rad2.diagonal() << 9e-4, 4e-4, 1.0;
  a.angular_velocity_radps = {0.0, 0.0, yaw_rate};
  return a;
}

TEST(AttitudeTrack, AFrameWaitsForTheEstimateAfterIt) {
  AttitudeTrack track;
  EXPECT_FALSE(track.is_due(0));
  EXPECT_FALSE(track.newest_ns());
  track.add(attitude(10 * kMs, 0.0, 0.0));
  EXPECT_FALSE(track.is_due(11 * kMs));
  EXPECT_FALSE(track.at(11 * kMs));
  EXPECT_TRUE(track.is_due(10 * kMs));
  EXPECT_TRUE(track.at(10 * kMs));
  // Before the first estimate nothing will ever be known: no need to wait.
  EXPECT_TRUE(track.is_due(9 * kMs));
  EXPECT_FALSE(track.at(9 * kMs));
  EXPECT_EQ(*track.newest_ns(), 10 * kMs);
}

TEST(AttitudeTrack, InterpolatesByHand) {
  AttitudeTrack track({.mounting_sigma_rad = 0.04, .max_gap_s = 0.1});
  track.add(attitude(0, 0.2, 1.0));
  track.add(attitude(10 * kMs, 0.3, 3.0));
  track.add(attitude(20 * kMs, 0.4, 3.0));
  const auto prior = track.at(12'500'000);
  ASSERT_TRUE(prior);
  EXPECT_NEAR(yaw_of(prior->world_from_body), 0.325, 1e-12);
  // Turned (1 + 3) / 2 * 10 ms, then a quarter of 3 * 10 ms.
  ASSERT_TRUE(prior->turn);
  EXPECT_NEAR(prior->turn->rad, 0.02 + 0.0075, 1e-12);
  // Larger tilt sigma 0.03 with the mounting's 0.04.
  EXPECT_NEAR(prior->inclination_sigma_rad, 0.05, 1e-12);
}

TEST(AttitudeTrack, TheTurnIsAboutTheVerticalWhateverTheAttitude) {
  AttitudeTrack track;
  const Eigen::Quaterniond lying = from_euler({0.5 * kPi, 0.0, 0.0});
  for (int i = 0; i <= 100; ++i) {
    AttitudeEstimate a = attitude(i * 10 * kMs, 0.0, 0.0);
    a.world_from_body = from_euler({0.0, 0.0, 0.01 * i}) * lying;
    a.angular_velocity_radps = lying.conjugate() * Eigen::Vector3d(0.0, 0.0, 1.0);
    track.add(a);
  }
  const auto prior = track.at(1000 * kMs);
  ASSERT_TRUE(prior);
  EXPECT_NEAR(prior->turn->rad, 1.0, 1e-12);
}

TEST(AttitudeTrack, AGapIsNotInterpolatedAndBeginsANewEpoch) {
  AttitudeTrack track;
  track.add(attitude(0, 0.0, 1.0));
  track.add(attitude(500 * kMs, 1.0, 1.0));
  EXPECT_TRUE(track.is_due(250 * kMs));
  EXPECT_FALSE(track.at(250 * kMs));
  ASSERT_TRUE(track.at(0));
  EXPECT_EQ(track.at(0)->turn->epoch, 0U);
  ASSERT_TRUE(track.at(500 * kMs));
  EXPECT_EQ(track.at(500 * kMs)->turn->epoch, 1U);
}

TEST(AttitudeTrack, LeavesOutWhatIsNotLaterAndForgetsTheOldest) {
  AttitudeTrack track;
  track.add(attitude(5 * kMs, 0.5, 0.0));
  track.add(attitude(5 * kMs, 0.9, 0.0));
  track.add(attitude(4 * kMs, 0.9, 0.0));
  ASSERT_TRUE(track.at(5 * kMs));
  EXPECT_NEAR(yaw_of(track.at(5 * kMs)->world_from_body), 0.5, 1e-12);
  for (int i = 6; i < 9000; ++i) track.add(attitude(i * kMs, 0.0, 0.0));
  EXPECT_FALSE(track.at(5 * kMs));
  EXPECT_TRUE(track.at(8500 * kMs));
}

}  // namespace
}  // namespace vpdr::vision
