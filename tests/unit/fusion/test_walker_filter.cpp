// S1.10 and S1.3 with hand-worked numbers: white noises, so that the printed equations remain.
#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "fusion/core/walker_filter.hpp"
#include "unit/fusion/survey.hpp"

namespace vpdr::fusion {
namespace {

using namespace survey;  // NOLINT: a test

TEST(WalkerFilter, FirstHeadingIsTakenAsItIs) {
  const WalkerFilter filter(as_in_the_survey());
  FilterState state = filter.initial();
  EXPECT_FALSE(state.has_heading);
  filter.apply(heading(1.0, 0.5, 0.1), state);
  EXPECT_TRUE(state.has_heading);
  EXPECT_DOUBLE_EQ(state.x[kYaw], 0.5);
  EXPECT_DOUBLE_EQ(state.p(kYaw, kYaw), 0.01);
  EXPECT_DOUBLE_EQ(state.p(kRate, kRate), 4.0);
}

TEST(WalkerFilter, PredictsByEquationNine) {
  const WalkerFilter filter(as_in_the_survey());
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.5, 1.0), state);
  state.x[kRate] = 0.2;
  filter.predict(2 * kSecond, state);
  // theta = 0.5 + 0.2*2. P = F diag(4,1) F' + 3*[[2 2][2 8/3]] = [[4 8][8 17]] + [[6 6][6 8]].
  EXPECT_DOUBLE_EQ(state.x[kYaw], 0.9);
  EXPECT_DOUBLE_EQ(state.p(kRate, kRate), 10.0);
  EXPECT_DOUBLE_EQ(state.p(kRate, kYaw), 14.0);
  EXPECT_DOUBLE_EQ(state.p(kYaw, kYaw), 25.0);
}

TEST(WalkerFilter, CorrectsByBothRowsOfEquationTen) {
  const WalkerFilter filter(as_in_the_survey());
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.5, 1.0), state);
  // Rate row at the same instant: S = 4 + 12 = 16, gain 1/4 on the rate, none on the heading.
  filter.apply(rate(0.0, 0.8, std::sqrt(12.0)), state);
  EXPECT_DOUBLE_EQ(state.x[kRate], 0.2);
  EXPECT_DOUBLE_EQ(state.p(kRate, kRate), 3.0);
  EXPECT_DOUBLE_EQ(state.x[kYaw], 0.5);
  // After 1 s: P = [[3 3][3 4]] + [[3 1.5][1.5 1]] = [[6 4.5][4.5 5]], theta = 0.7.
  // Heading row: S = 5 + 5 = 10, gains 0.45 and 0.5, innovation 0.2.
  filter.apply(heading(1.0, 0.9, std::sqrt(5.0)), state);
  EXPECT_NEAR(state.x[kRate], 0.2 + 0.45 * 0.2, 1e-12);
  EXPECT_NEAR(state.x[kYaw], 0.7 + 0.5 * 0.2, 1e-12);
  EXPECT_NEAR(state.p(kRate, kRate), 6.0 - 4.5 * 4.5 / 10.0, 1e-12);
  EXPECT_NEAR(state.p(kRate, kYaw), 4.5 - 4.5 * 5.0 / 10.0, 1e-12);
  EXPECT_NEAR(state.p(kYaw, kYaw), 2.5, 1e-12);
}

TEST(WalkerFilter, MeanOverTheLastStepLagsBehindATurn) {
  // Turning at 0.5 rad/s for 4 s, heading published 0.25 s late: the filter is not.
  FusionConfig config = as_in_the_survey();
  config.heading.noise = HeadingNoise::kCorrelated;
  config.heading.bias_sigma_rad = 0.0;
  config.heading.delay_s = 0.25;
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  for (int i = 0; i <= 80; ++i) {
    const double t = 0.05 * i;
    filter.apply(heading(t, 0.5 * (t - 0.25), 0.01), state);
  }
  EXPECT_NEAR(state.x[kRate], 0.5, 0.02);
  EXPECT_NEAR(state.x[kYaw], 2.0, 0.02);
  EXPECT_NEAR(state.correction_rad, 0.0, 0.01);
}

TEST(WalkerFilter, TransitionAsPrintedLosesAStraightWalk) {
  // The same straight walk along 1 rad, seen every second: the corrected filter stays on it, the
  // printed one predicts 0 each time and is dragged off by a third of the way or more.
  for (const TransitionForm form : {TransitionForm::kCorrected, TransitionForm::kAsPrinted}) {
    FusionConfig config = as_in_the_survey();
    config.heading.transition = form;
    config.heading.turn_density = 0.01;
    config.heading.turn_rate_sigma_radps = 0.1;
    const WalkerFilter filter(config);
    FilterState state = filter.initial();
    for (int i = 0; i < 20; ++i) {
      filter.apply(rate(i, 0.0, 0.05), state);
      filter.apply(heading(i, 1.0, 0.3), state);
    }
    if (form == TransitionForm::kCorrected) {
      EXPECT_NEAR(state.x[kYaw], 1.0, 1e-9);
    } else {
      EXPECT_LT(state.x[kYaw], 0.7);
    }
  }
}

TEST(WalkerFilter, HeadingsOnBothSidesOfPiAgree) {
  for (const double side : {1.0, -1.0}) {
    const WalkerFilter filter(as_in_the_survey());
    FilterState state = filter.initial();
    filter.apply(heading(0.0, side * (kPi - 0.1), 1.0), state);
    // 0.2 rad further across the cut: halfway lies on the cut itself.
    filter.apply(heading(0.0, side * (-kPi + 0.1), 1.0), state);
    EXPECT_NEAR(std::abs(state.x[kYaw]), kPi, 1e-12);
    // And a rate that carries it across.
    filter.apply(rate(0.0, side * 0.3, 0.001), state);
    filter.predict(kSecond, state);
    EXPECT_NEAR(wrap_pi(state.x[kYaw] - side * (-kPi + 0.3)), 0.0, 1e-3);
    EXPECT_GE(state.x[kYaw], -kPi);
    EXPECT_LT(state.x[kYaw], kPi);
  }
}

TEST(WalkerFilter, LongGapForgetsTheRate) {
  FusionConfig config = as_in_the_survey();
  config.heading.max_prediction_s = 0.5;
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.5, 0.1), state);
  state.x[kRate] = 1.0;
  filter.predict(kSecond, state);
  // Held, and as uncertain as a second of turning at 2 rad/s: 0.01 + 4.
  EXPECT_DOUBLE_EQ(state.x[kYaw], 0.5);
  EXPECT_DOUBLE_EQ(state.x[kRate], 0.0);
  EXPECT_DOUBLE_EQ(state.p(kYaw, kYaw), 4.01);
}

TEST(WalkerFilter, ImprobableHeadingIsRefusedAndCounted) {
  FusionConfig config = as_in_the_survey();
  config.heading.turn_density = 1e-6;
  config.heading.turn_rate_sigma_radps = 1e-3;
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.0, 0.01), state);
  const StateVector before = state.x;
  // Innovation deviation sqrt(0.01^2 + 0.01^2) = 0.01414: 0.05 is 3.5 of them, 0.04 is 2.8.
  filter.apply(heading(0.0, 0.05, 0.01), state);
  EXPECT_EQ(state.headings.gated, 1U);
  EXPECT_EQ(state.x, before);
  filter.apply(heading(0.0, 0.04, 0.01), state);
  EXPECT_EQ(state.headings.accepted, 1U);
  EXPECT_NEAR(state.x[kYaw], 0.02, 1e-9);
  EXPECT_NEAR(state.headings.nis_sum, 0.04 * 0.04 / 2e-4, 1e-9);
}

TEST(WalkerFilter, HeadingRefusedForTwoSecondsIsTaken) {
  FusionConfig config = as_in_the_survey();
  config.heading.turn_density = 1e-8;
  config.heading.turn_rate_sigma_radps = 1e-4;
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.0, 0.01), state);
  for (double t = 0.1; t < 2.05; t += 0.1) filter.apply(heading(t, 1.5, 0.01), state);
  EXPECT_EQ(state.headings.resets, 0U);
  EXPECT_NEAR(state.x[kYaw], 0.0, 1e-6);
  filter.apply(heading(2.1, 1.5, 0.01), state);
  EXPECT_EQ(state.headings.resets, 1U);
  EXPECT_DOUBLE_EQ(state.x[kYaw], 1.5);
  filter.apply(heading(2.2, 1.5, 0.01), state);
  EXPECT_EQ(state.headings.accepted, 1U);
}

TEST(WalkerFilter, FindingNorthTurnsTheTrackAboutItsStart) {
  FusionConfig config = as_in_the_survey();
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.0, 0.1), state);
  filter.apply(step(0.0, 2.0), state);
  HeadingEstimate north = heading(0.1, kPi / 2.0, 0.2);
  north.yaw_is_absolute = true;
  filter.apply(north, state);
  EXPECT_NEAR(state.x[kX], 0.0, 1e-12);
  EXPECT_NEAR(state.x[kY], 2.0, 1e-12);
  // A predicted turn between the two headings aside, the old 0.1 rad falls away and the new 0.2 rad
  // swings the 2 m: x and yaw err together, the other way round.
  EXPECT_NEAR(state.p(kYaw, kYaw), 0.04, 1e-12);
  EXPECT_NEAR(state.p(kX, kYaw), -2.0 * 0.04, 1e-12);
  EXPECT_NEAR(state.p(kY, kY), 0.0, 1e-12);
  EXPECT_GE(state.p(kX, kX), 4.0 * 0.04 - 1e-12);
}

TEST(WalkerFilter, AnotherZeroOfYawIsTakenAtOnce) {
  const WalkerFilter filter(as_in_the_survey());
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.0, 0.01), state);
  HeadingEstimate north = heading(0.1, 2.0, 0.05);
  north.yaw_is_absolute = true;
  filter.apply(north, state);
  EXPECT_DOUBLE_EQ(state.x[kYaw], 2.0);
  EXPECT_TRUE(state.yaw_is_absolute);
  EXPECT_EQ(state.headings.gated, 0U);
}

TEST(WalkerFilter, AWalkEndsShortOfWhereItsLastStepLed) {
  const WalkerFilter filter(as_in_the_survey());
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.5 * kPi, 1e-6), state);
  StepEvent last;
  last.stamp_ns = kSecond;
  last.length_m = 0.8;
  last.frequency_hz = 2.0;
  filter.apply(last, state);
  EXPECT_NEAR(state.x[kY], 0.8, 1e-9);
  // The next one, after a halt: 0.6 of the last is taken back, +- 0.4 of it.
  const double before = state.p(kY, kY);
  StepEvent next = last;
  next.stamp_ns = 5 * kSecond;
  next.length_m = 0.0;
  filter.apply(next, state);
  EXPECT_NEAR(state.x[kY], 0.8 - 0.48, 1e-6);
  EXPECT_NEAR(state.p(kY, kY) - before, 0.32 * 0.32, 1e-6);
  EXPECT_NEAR(state.distance_m, 0.32, 1e-6);
}

}  // namespace
}  // namespace vpdr::fusion
