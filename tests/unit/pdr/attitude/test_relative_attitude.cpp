#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "pdr/core/attitude/field_average.hpp"
#include "pdr/core/attitude/relative_attitude.hpp"
#include "tests/unit/pdr/made_walk.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using made::Motion;
using made::Readings;

TEST(RelativeAttitude, FollowsTurnsFromYawZero) {
  Motion motion;
  motion.angles = [](double t) { return EulerAngles{0.1, -0.2, 1.0 + 0.3 * t}; };
  RelativeAttitude attitude({});
  for (const ImuSample& s : made::read(motion, 10.0, 100.0).imu) attitude.process(s);
  EXPECT_NEAR(wrap_pi(yaw_of(attitude.odom_from_body()) - 3.0), 0.0, 0.01);
  const RelativeMotion passed = attitude.take_motion();
  EXPECT_NEAR(passed.elapsed_s, 10.0, 1e-9);
  EXPECT_NEAR(passed.turned_rad, 3.0, 0.05);
  EXPECT_EQ(passed.blind_rad2, 0.0);
  EXPECT_EQ(attitude.take_motion().elapsed_s, 0.0);
}

TEST(RelativeAttitude, ABiasLearnedAtRestIsToldAndDoesNotTurnThePast) {
  Readings readings = made::read(Motion{}, 20.0, 100.0);
  for (ImuSample& s : readings.imu) s.angular_velocity_radps.z() += 0.02;
  RelativeAttitude attitude({});
  double largest_jump = 0.0;
  Vector3d taken_off = Vector3d::Zero();
  std::optional<Vector3d> first_rest;
  double yaw = 0.0;
  for (const ImuSample& s : readings.imu) {
    attitude.process(s);
    const double now = yaw_of(attitude.odom_from_body());
    largest_jump = std::max(largest_jump, std::abs(wrap_pi(now - yaw)));
    yaw = now;
    const RelativeMotion motion = attitude.take_motion();
    if (motion.rest_bias_radps && !first_rest) first_rest = motion.rest_bias_radps;
    taken_off += motion.bias_change_radps;
  }
  ASSERT_TRUE(first_rest);
  EXPECT_LT((*first_rest - Vector3d(0.0, 0.0, 0.02)).norm(), 1e-6);
  EXPECT_LT((taken_off - Vector3d(0.0, 0.0, 0.02)).norm(), 1e-3);
  EXPECT_LT(largest_jump, 0.02 * 0.011);
  EXPECT_TRUE(attitude.at_rest());
}

TEST(RelativeAttitude, CountsWhatNoGyroscopeSaw) {
  Readings readings = made::read(Motion{}, 4.0, 100.0);
  std::erase_if(readings.imu, [](const ImuSample& s) {
    return s.stamp_ns > to_ns(1.0) && s.stamp_ns < to_ns(3.0);
  });
  AttitudeConfig config;
  config.gap_rate_radps = 0.5;
  RelativeAttitude attitude(config);
  for (const ImuSample& s : readings.imu) attitude.process(s);
  EXPECT_NEAR(attitude.take_motion().blind_rad2, 1.0, 0.02);  // (0.5 rad/s 2 s)^2

  RelativeAttitude without(config);
  for (ImuSample s : made::read(Motion{}, 4.0, 100.0).imu) {
    s.has_angular_velocity = false;
    without.process(s);
  }
  EXPECT_NEAR(without.take_motion().blind_rad2, 0.25 * 4.0, 1e-6);
}

TEST(FieldAverage, IsTheSameWhicheverOfEqualStampsComesFirst) {
  Motion motion;
  motion.angles = [](double t) { return EulerAngles{0.1, 0.2, 0.8 * t}; };
  const Readings readings = made::read(motion, 0.4, 100.0);
  FieldAverage before(0.25, 0.5);
  FieldAverage after(0.25, 0.5);
  std::optional<MeanField> a;
  std::optional<MeanField> b;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    const ImuSample& imu = readings.imu[i];
    before.add(readings.mag[i]);
    before.advance(imu.stamp_ns, readings.truth[i], imu.angular_velocity_radps);
    after.advance(imu.stamp_ns, readings.truth[i], imu.angular_velocity_radps);
    after.add(readings.mag[i]);
    if (!a) a = before.take();
    if (!b) b = after.take();
  }
  ASSERT_TRUE(a && b);
  EXPECT_LT((a->horizontal_ut - made::kField.head<2>()).norm(), 1e-3);
  EXPECT_LT((a->horizontal_ut - b->horizontal_ut).norm(), 1e-3);
  // The body turned 0.2 rad meanwhile; its forward axis on the average.
  EXPECT_NEAR(std::atan2(a->level_rows(1, 0), a->level_rows(0, 0)), 0.1, 0.02);
}

TEST(FieldAverage, AnOldFieldIsNotUsed) {
  FieldAverage average(0.05, 0.5);
  average.add({0, Vector3d(30.0, 0.0, 0.0)});
  average.advance(to_ns(1.0), Eigen::Quaterniond::Identity(), Vector3d::Zero());
  average.advance(to_ns(2.0), Eigen::Quaterniond::Identity(), Vector3d::Zero());
  EXPECT_FALSE(average.take());
}

}  // namespace
}  // namespace vpdr::pdr
