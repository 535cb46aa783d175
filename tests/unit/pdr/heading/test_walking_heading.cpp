#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "pdr/core/heading/walking_heading.hpp"
#include "pdr/core/pdr.hpp"
#include "tests/unit/pdr/made_walk.hpp"

namespace vpdr::pdr {
namespace {

constexpr TimestampNs kMs = 1'000'000;

TEST(WalkingHeading, AveragesSwayOverAStep) {
  WalkingHeading heading;
  // Sways 0.2 rad at 2 Hz about 0.7 rad.
  for (int i = 0; i <= 500; ++i) {
    const double yaw = 0.7 + 0.2 * std::sin(2.0 * kPi * 2.0 * 0.005 * i);
    heading.add(i * 5 * kMs, forward_heading(from_euler({0.1, -0.2, yaw})));
  }
  EXPECT_NEAR(heading.mean(1000 * kMs, 1500 * kMs).yaw_rad, 0.7, 1e-3);
  EXPECT_NEAR(heading.mean(1730 * kMs, 2230 * kMs).yaw_rad, 0.7, 1e-3);
}

TEST(WalkingHeading, APhoneInTheHandTurnsAboutItsOwnersWay) {
  HeadingConfig config;
  config.sway_sigma_rad = 0.03;
  config.loose_sigma_rad = 0.3;
  for (const Carry carry : {Carry::kWaist, Carry::kChest, Carry::kHead}) {
    EXPECT_EQ(sway_sigma_rad(config, carry), 0.03);
  }
  for (const Carry carry : {Carry::kHand, Carry::kPocket, Carry::kUnknown}) {
    EXPECT_EQ(sway_sigma_rad(config, carry), 0.3);
  }
}

TEST(WalkingHeading, AveragesAcrossTheWrap) {
  WalkingHeading heading;
  for (int i = 0; i <= 200; ++i) {
    heading.add(i * 10 * kMs,
                forward_heading(from_euler({0.0, 0.0, kPi + (i % 2 == 0 ? 0.1 : -0.1)})));
  }
  EXPECT_NEAR(std::abs(heading.mean(0, 2000 * kMs).yaw_rad), kPi, 1e-6);
}

TEST(WalkingHeading, SaysHowClearTheDirectionIs) {
  WalkingHeading level;
  WalkingHeading upright;
  for (int i = 0; i <= 100; ++i) {
    level.add(i * 10 * kMs, forward_heading(from_euler({0.0, 0.0, 1.0})));
    upright.add(i * 10 * kMs, forward_heading(from_euler({0.0, -0.5 * kPi + 0.01, 1.0})));
  }
  EXPECT_NEAR(level.mean(0, 1000 * kMs).clarity, 1.0, 1e-9);
  EXPECT_LT(upright.mean(0, 1000 * kMs).clarity, 0.02);
}

TEST(WalkingHeading, IsCutToWhatItRemembers) {
  WalkingHeading heading;
  EXPECT_EQ(heading.mean(0, 10 * kMs).clarity, 0.0);
  for (int i = 0; i <= 3000; ++i) {
    heading.add(i * 5 * kMs, forward_heading(from_euler({0.0, 0.0, i < 1000 ? -1.0 : 1.0})));
  }
  EXPECT_NEAR(heading.mean(0, 15000 * kMs).yaw_rad, 1.0, 1e-9);  // the first 5 s are forgotten
  heading.reset();
  EXPECT_EQ(heading.mean(0, 20000 * kMs).clarity, 0.0);
}

TEST(Pdr, KnowsItsHeadingWhenTheFirstWordOfAWalkTakesAPeakBack) {
  // One bump, then a walk out of step with it: the bump is withdrawn before a step is confirmed.
  // The frequency of no step is no period: the sanitizers tell.
  made::Motion motion;
  motion.upward_mps2 = [](double t) {
    if (t < 2.5) return 3.0 * std::exp(-0.5 * std::pow((t - 2.0) / 0.08, 2));
    return t < 3.0 ? 0.0 : 3.0 * std::cos(2.0 * kPi * 1.8 * (t - 3.0));
  };
  PdrConfig config;
  config.carry = Carry::kHand;
  Pdr pdr(config);
  PdrOutput output;
  bool came = false;
  for (const ImuSample& sample : made::read(motion, 8.0, 100.0, to_ns(1.5e9)).imu) {
    pdr.process(sample, output);
    came = came || (pdr.walking() && pdr.step_count() == 0);
    if (!output.heading || sample.stamp_ns < to_ns(1.5e9 + 1.0)) continue;
    ASSERT_LT(output.heading->yaw_sigma_rad, 0.5) << sample.stamp_ns;
  }
  EXPECT_TRUE(came);
  EXPECT_GT(pdr.step_count(), 5U);
}

}  // namespace
}  // namespace vpdr::pdr
