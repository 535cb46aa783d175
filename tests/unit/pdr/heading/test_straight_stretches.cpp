#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/rotation.hpp"
#include "pdr/core/heading/straight_stretches.hpp"
#include "pdr/core/pdr.hpp"
#include "tests/unit/pdr/made_walk.hpp"

namespace vpdr::pdr {
namespace {

/// Eight steps that way; what the last of them tells.
std::optional<StraightStretch> stretch(StraightStretches& stretches, double yaw_rad) {
  std::optional<StraightStretch> last;
  for (int i = 0; i < 8; ++i) last = stretches.take(yaw_rad + (i % 2 == 0 ? 0.03 : -0.03));
  return last;
}

TEST(StraightStretches, FromTheFourthOnTheyAreUsualAndSoAreTheirCrossings) {
  StraightStretches stretches(StraightConfig{});
  for (const double yaw : {0.3, 0.3 + 0.5 * kPi, 0.3 + kPi}) {
    const auto early = stretch(stretches, yaw);
    ASSERT_TRUE(early);
    EXPECT_NEAR(wrap_pi(early->direction_rad - yaw), 0.0, 1e-9);
    EXPECT_FALSE(early->is_usual) << "too few to tell";
  }
  const auto along = stretch(stretches, 0.4);
  ASSERT_TRUE(along && along->is_usual);
  EXPECT_NEAR(along->direction_rad, 0.4, 1e-9);
  EXPECT_NEAR(along->variance_rad2, 0.04, 1e-9);  // they agreed wholly
  const auto across = stretch(stretches, 0.25 - 0.5 * kPi);
  ASSERT_TRUE(across);
  EXPECT_TRUE(across->is_usual);
}

TEST(StraightStretches, BendsAndOtherDirectionsAreNotUsual) {
  StraightStretches stretches(StraightConfig{});
  for (int i = 0; i < 4; ++i) stretch(stretches, 0.0);
  const auto other = stretch(stretches, 0.4);  // a corridor of its own
  ASSERT_TRUE(other);
  EXPECT_FALSE(other->is_usual);
  for (int i = 0; i < 40; ++i) EXPECT_FALSE(stretches.take(0.03 * i));  // a curve
}

TEST(StraightStretches, DirectionsWithoutAPatternAreNotUsual) {
  StraightStretches stretches(StraightConfig{});
  for (int i = 0; i < 40; ++i) {
    const auto seen = stretch(stretches, 0.35 * i);
    EXPECT_FALSE(seen && seen->is_usual) << i;
  }
}

constexpr double kStretchVariance = 0.04;

StraightStretch along(double direction_rad, bool is_usual = true) {
  return {direction_rad, kStretchVariance, is_usual};
}

/// A walker without a magnetometer whose heading is known to `sigma_rad`, by a minute of drift.
DeadReckoning drifted(double sigma_rad) {
  DeadReckoningConfig config;
  config.bias_sigma_radps = sigma_rad / 60.0;
  config.rate_noise_rad_sqrt_s = 1e-6;
  config.forward_sigma_rad = 1e-6;
  DeadReckoning track(config);
  RelativeMotion motion;
  motion.elapsed_s = 60.0;
  motion.up_s = {0.0, 0.0, 60.0};
  track.pass(motion);
  return track;
}

TEST(CorridorOfAWalk, IsAsWrongAsTheHeadingItWasFirstSeenWith) {
  // The heading is 0.1 rad off from the start on; the corridor is seen 0.1 rad off as well, however
  // often: it cannot tell more of the world than was known then.
  DeadReckoning track = drifted(0.1);
  const double before = track.walking_variance_rad2();
  for (int i = 0; i < 50; ++i) track.take(along(0.7));
  EXPECT_EQ(track.walking_offset_rad(), 0.0);
  EXPECT_NEAR(track.walking_variance_rad2(), before, 1e-9);
}

TEST(CorridorOfAWalk, TellsWhatTheHeadingDriftedSince) {
  DeadReckoning track = drifted(1e-4);
  track.take(along(0.7));
  RelativeMotion drifting;
  drifting.elapsed_s = 1.0;
  drifting.up_s = {0.0, 0.0, 1.0};
  drifting.blind_rad2 = 0.01;  // 0.1 rad
  track.pass(drifting);
  track.take(along(0.8 + 0.5 * kPi));  // across, and 0.1 rad too far round
  // By hand: of 0.01 unsure and 0.04 + 0.04 of the two stretches, a ninth of the 0.1 rad.
  EXPECT_NEAR(track.walking_offset_rad(), -0.1 * 0.01 / 0.09, 1e-4);
  EXPECT_NEAR(track.walking_variance_rad2(), 0.01 - 0.01 * 0.01 / 0.09, 1e-5);
}

TEST(CorridorOfAWalk, IsGivenUpForTheUsualOne) {
  DeadReckoning track = drifted(0.1);
  track.take(along(0.4, false));  // a slanting one at first
  for (int i = 0; i < 3; ++i) track.take(along(0.0));
  EXPECT_EQ(track.walking_offset_rad(), 0.0) << "nothing is bent towards the first one";
}

/// Walks with a gyroscope that is off by `bias_radps`, without any rest, and with a magnetometer
/// for the first `field_s` seconds.
Eigen::Vector2d end_of(const std::function<double(double)>& yaw, double duration_s,
                       double bias_radps, bool use, double field_s = 0.0) {
  made::Motion motion;
  motion.angles = [&](double t) { return EulerAngles{0.0, 0.0, yaw(t)}; };
  motion.upward_mps2 = made::bounce(1.8);
  made::Readings readings = made::read(motion, duration_s, 50.0, 0, field_s > 0.0);
  for (ImuSample& sample : readings.imu) sample.angular_velocity_radps.z() += bias_radps;
  PdrConfig config;
  config.carry = Carry::kChest;
  config.straight.use = use;
  Pdr pdr(config);
  PdrOutput output;
  auto field = readings.mag.begin();
  for (const ImuSample& sample : readings.imu) {
    for (; field != readings.mag.end() && field->stamp_ns <= sample.stamp_ns; ++field) {
      const double walked_s = to_seconds(field->stamp_ns - readings.mag.front().stamp_ns);
      if (walked_s < field_s) pdr.process(*field);
    }
    pdr.process(sample, output);
  }
  return pdr.dead_reckoning().position_m();
}

/// Up and down a corridor of half a minute: each second way back to the start.
double corridor(double t) {
  const double ways = std::floor(t / 30.0);
  const double turning = std::clamp((t - 30.0 * ways) / 1.5, 0.0, 1.0);
  return kPi * (ways > 0.0 ? ways - 1.0 + turning : 0.0);
}

TEST(Pdr, CorridorsHoldTheHeadingWithoutAMagnetometer) {
  const double bias = 0.003;
  const double with = end_of(corridor, 300.0, bias, true).norm();
  const double without = end_of(corridor, 300.0, bias, false).norm();
  EXPECT_GT(without, 10.0);
  EXPECT_LT(with, 0.35 * without);
}

TEST(Pdr, CorridorsHoldTheHeadingWhereTheMagnetometerFailed) {
  // The bias that is not known any more appears with the failure: 1.5 ways up and down are known.
  const auto bent = [](double t) { return corridor(t) + 0.003 * std::max(0.0, t - 90.0); };
  const Eigen::Vector2d straight = end_of(corridor, 300.0, 0.0, false, 90.0);
  const double with = (end_of(bent, 300.0, 0.0, true, 90.0) - straight).norm();
  const double without = (end_of(bent, 300.0, 0.0, false, 90.0) - straight).norm();
  EXPECT_GT(without, 10.0);
  EXPECT_LT(with, 0.35 * without);
}

TEST(Pdr, ARoundWalkIsNotBent) {
  // A circle of 15 m radius: 0.7 m to each step, 2.7 degrees.
  const auto circle = [](double t) { return t * 1.8 * 0.7 / 15.0; };
  const Eigen::Vector2d with = end_of(circle, 200.0, 0.0, true);
  const Eigen::Vector2d without = end_of(circle, 200.0, 0.0, false);
  EXPECT_EQ(with, without);
}

}  // namespace
}  // namespace vpdr::pdr
