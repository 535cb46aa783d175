#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "pdr/core/attitude/attitude_filter.hpp"
#include "pdr/core/attitude/complementary_filter.hpp"
#include "tests/unit/pdr/made_walk.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond yaw(double rad) { return from_euler({0.0, 0.0, rad}); }

TEST(ComplementaryFilter, FirstOrderStepIsAsPrinted) {
  // q + q (0, w) dt / 2 with w dt = (0, 0, 0.2): (1, 0, 0, 0.1), normalised: 2 atan 0.1 = 11.421
  // deg against 11.459 deg of the exact rotation.
  const Quaterniond q = first_order_step(Quaterniond::Identity(), Vector3d(0.0, 0.0, 0.2));
  EXPECT_NEAR(to_degrees(yaw_of(q)), 11.42119, 1e-5);
  EXPECT_NEAR(q.z() / q.w(), 0.1, 1e-12);
}

TEST(ComplementaryFilter, OneStepByHand) {
  // k = 0.5 / s, dt = 0.1 s, estimate 0, C_0 = 0.4 rad, w = 1 rad/s: the angle of the step is
  // 1 * 0.1 + 0.5 * 0.1 * 0.4 = 0.12 rad; first order: 2 atan(0.06) = 0.119856 rad.
  ComplementaryConfig config;
  config.time_constant_s = 2.0;
  ComplementaryFilter filter(config);
  filter.start(Quaterniond::Identity());
  filter.step(Vector3d(0.0, 0.0, 1.0), yaw(0.4), 0.1);
  EXPECT_NEAR(yaw_of(filter.world_from_body()), 2.0 * std::atan(0.06), 1e-12);
}

TEST(ComplementaryFilter, LowPassOfTheMeasuredAttitude) {
  // G_1 alone (no rate): what is missing shrinks by 1 - dt / tau a step; after tau seconds in 100
  // steps 0.99^100 = 0.366 of it is left.
  ComplementaryConfig config;
  config.time_constant_s = 2.0;
  ComplementaryFilter filter(config);
  filter.start(Quaterniond::Identity());
  for (int i = 0; i < 100; ++i) filter.step(Vector3d::Zero(), yaw(0.1), 0.02);
  EXPECT_NEAR(yaw_of(filter.world_from_body()), 0.1 * (1.0 - std::pow(0.99, 100)), 1e-6);
}

TEST(ComplementaryFilter, HighPassOfTheGyroscope) {
  // G_2 alone (C_0 stays): a bias b comes through as b tau, and no further.
  ComplementaryConfig config;
  config.time_constant_s = 2.0;
  ComplementaryFilter filter(config);
  filter.start(Quaterniond::Identity());
  for (int i = 0; i < 4000; ++i) filter.step(Vector3d(0.0, 0.0, 0.01), yaw(0.0), 0.01);
  EXPECT_NEAR(yaw_of(filter.world_from_body()), 0.02, 1e-6);
}

TEST(ComplementaryFilter, BothHalvesTogetherLoseNothing) {
  // (2) G_1 + G_2 = 1: where both tell the truth the sum is the truth, at any time constant.
  for (const double tau : {0.1, 1.0, 10.0}) {
    ComplementaryConfig config;
    config.time_constant_s = tau;
    ComplementaryFilter filter(config);
    filter.start(yaw(0.0));
    for (int i = 1; i <= 1000; ++i) {
      filter.step(Vector3d(0.0, 0.0, 0.5), yaw(0.5 * 0.01 * (i - 1)), 0.01);
    }
    EXPECT_NEAR(wrap_pi(yaw_of(filter.world_from_body()) - 5.0), 0.0, 1e-5) << tau;
  }
}

TEST(ComplementaryFilter, ServesAsBaselineOfTheAttitudeFilter) {
  AttitudeConfig config;
  config.filter = AttitudeMethod::kComplementary;
  AttitudeFilter filter(config);
  made::Motion motion;
  motion.angles = [](double t) { return EulerAngles{0.1, -0.2, 0.5 + 0.4 * t}; };
  const made::Readings readings = made::read(motion, 20.0, 100.0);
  double largest = 0.0;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    filter.process(readings.mag[i]);
    filter.process(readings.imu[i]);
    largest =
        std::max(largest, filter.estimate().world_from_body.angularDistance(readings.truth[i]));
  }
  EXPECT_LT(largest, to_radians(1.0));
  EXPECT_TRUE(filter.estimate().yaw_is_absolute);
  // It promises what the paper does: 0.6 deg and 1.2 deg (S3.6).
  EXPECT_NEAR(to_degrees(std::sqrt(filter.estimate().covariance_rad2(0, 0))), 0.6, 0.01);
  EXPECT_NEAR(to_degrees(std::sqrt(filter.estimate().covariance_rad2(2, 2))), 1.2, 0.01);
}

TEST(ComplementaryFilter, WithoutAFieldTheGyroscopeHasTheHeading) {
  AttitudeConfig config;
  config.filter = AttitudeMethod::kComplementary;
  config.use_magnetometer = false;
  AttitudeFilter filter(config);
  made::Motion motion;
  motion.angles = [](double t) { return EulerAngles{0.0, 0.0, 0.3 * t}; };
  const made::Readings readings = made::read(motion, 10.0, 100.0);
  for (const ImuSample& sample : readings.imu) filter.process(sample);
  EXPECT_NEAR(wrap_pi(yaw_of(filter.world_from_body()) - 3.0), 0.0, 0.01);
  EXPECT_FALSE(filter.estimate().yaw_is_absolute);
}

}  // namespace
}  // namespace vpdr::pdr
