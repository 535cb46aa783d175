#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "core/rotation.hpp"
#include "made_walk.hpp"
#include "pdr/core/pdr.hpp"
#include "pdr/core/straight_stretches.hpp"

namespace vpdr::pdr {
namespace {

/// Eight steps that way; what the last of them tells.
std::optional<StretchOffset> stretch(StraightStretches& stretches, double yaw_rad) {
  std::optional<StretchOffset> last;
  for (int i = 0; i < 8; ++i) last = stretches.take(yaw_rad + (i % 2 == 0 ? 0.03 : -0.03));
  return last;
}

TEST(StraightStretches, TheThirdStretchAndItsCrossingsAreCompared) {
  StraightStretches stretches(StraightConfig{});
  EXPECT_FALSE(stretch(stretches, 0.3));
  EXPECT_FALSE(stretch(stretches, 0.3 + 0.5 * kPi));
  EXPECT_FALSE(stretch(stretches, 0.3 + kPi));
  const auto along = stretch(stretches, 0.4);
  ASSERT_TRUE(along);
  EXPECT_NEAR(along->offset_rad, 0.1, 1e-9);
  EXPECT_NEAR(along->variance_rad2, 0.04, 1e-9);  // they agreed wholly
  const auto across = stretch(stretches, 0.25 - 0.5 * kPi);
  ASSERT_TRUE(across);
  EXPECT_NEAR(across->offset_rad, -0.05 - 0.1 / 4.0, 0.01);  // the last one moved the usual
}

TEST(StraightStretches, BendsAndOtherDirectionsSayNothing) {
  StraightStretches stretches(StraightConfig{});
  for (int i = 0; i < 4; ++i) stretch(stretches, 0.0);
  EXPECT_FALSE(stretch(stretches, 0.4));                                // a corridor of its own
  for (int i = 0; i < 40; ++i) EXPECT_FALSE(stretches.take(0.03 * i));  // a curve
}

TEST(StraightStretches, DirectionsWithoutAPatternSayNothing) {
  StraightStretches stretches(StraightConfig{});
  for (int i = 0; i < 40; ++i) EXPECT_FALSE(stretch(stretches, 0.35 * i)) << i;
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
