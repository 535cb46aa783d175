// Position by steps (S1.3) with hand-worked numbers.
#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "fusion/core/walker_filter.hpp"
#include "unit/fusion/survey.hpp"

namespace vpdr::fusion {
namespace {

using namespace survey;  // NOLINT: a test

TEST(WalkerFilter, StepsWalkAlongTheHeading) {
  const WalkerFilter filter(as_in_the_survey());
  FilterState state = filter.initial();
  filter.apply(heading(0.0, kPi / 6.0, 1e-6), state);
  filter.apply(step(0.0, 0.8), state);
  EXPECT_NEAR(state.x[kX], 0.8 * std::sqrt(3.0) / 2.0, 1e-12);
  EXPECT_NEAR(state.x[kY], 0.4, 1e-12);
  EXPECT_EQ(state.steps, 1U);
  EXPECT_DOUBLE_EQ(state.distance_m, 0.8);
}

TEST(WalkerFilter, StepCovarianceByHand) {
  FusionConfig config = as_in_the_survey();
  config.step.direction_sigma_rad = 0.3;
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.0, 0.1), state);
  filter.apply(step(0.0, 2.0, 0.5), state);
  // Eastward: x varies by the length (0.25), y by heading and direction, 4*(0.01 + 0.09).
  EXPECT_NEAR(state.p(kX, kX), 0.25, 1e-12);
  EXPECT_NEAR(state.p(kY, kY), 0.4, 1e-12);
  EXPECT_NEAR(state.p(kX, kY), 0.0, 1e-12);
  EXPECT_NEAR(state.p(kY, kYaw), 2.0 * 0.01, 1e-12);
}

TEST(WalkerFilter, ScaleAndHeadingErrorsAddUpFromStepToStep) {
  // Ten steps of 1 m with a 5 % scale error and a constant 0.1 rad heading error: 0.5 m along and
  // 1 m across, not the square root of ten steps' worth.
  FusionConfig config = as_in_the_survey();
  config.step.scale_sigma = 0.05;
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.0, 0.1), state);
  for (int i = 0; i < 10; ++i) {
    StepEvent event = step(0.0, 1.0, 0.05);  // all of it the person's
    event.index = static_cast<std::uint32_t>(i);
    filter.apply(event, state);
  }
  EXPECT_NEAR(std::sqrt(state.p(kX, kX)), 0.5, 1e-12);
  EXPECT_NEAR(std::sqrt(state.p(kY, kY)), 1.0, 1e-12);
}

TEST(WalkerFilter, LaterHeadingStraightensWhatWasWalked) {
  // The heading of the first 10 m was 0.1 rad wrong; a precise one at the same instant says so.
  const WalkerFilter filter(as_in_the_survey());
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.1, 0.2), state);
  filter.apply(step(0.0, 10.0), state);
  EXPECT_NEAR(state.x[kY], 10.0 * std::sin(0.1), 1e-12);
  filter.apply(heading(0.0, 0.0, 0.001), state);
  EXPECT_NEAR(state.x[kY], 0.0, 0.02);
  EXPECT_LT(std::sqrt(state.p(kY, kY)), 0.05);
}

TEST(WalkerFilter, ATentativeStepIsWorthItsProbability) {
  const WalkerFilter filter(as_in_the_survey());
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.0, 1e-9), state);
  StepEvent event = step(0.0, 0.8, 0.1);
  event.status = StepStatus::kTentative;
  event.probability = 0.75;
  filter.apply(event, state);
  EXPECT_NEAR(state.x[kX], 0.6, 1e-9);
  // p sigma^2 + p (1 - p) l^2 = 0.75 x 0.01 + 0.1875 x 0.64.
  EXPECT_NEAR(state.p(kX, kX), 0.1275, 1e-9);
  EXPECT_EQ(state.steps, 0U);
  event.status = StepStatus::kWithdrawn;
  filter.apply(event, state);
  EXPECT_NEAR(state.x[kX], 0.6, 1e-9);
}

TEST(WalkerFilter, StepBeforeAnyHeadingBringsItsOwn) {
  const WalkerFilter filter(as_in_the_survey());
  FilterState state = filter.initial();
  StepEvent event = step(1.0, 0.7);
  event.yaw_rad = kPi / 2.0;
  filter.apply(event, state);
  EXPECT_TRUE(state.has_heading);
  EXPECT_NEAR(state.x[kY], 0.7, 1e-12);
}

TEST(WalkerFilter, StepDeviationIsSplitIntoPersonAndStep) {
  FusionConfig config = as_in_the_survey();
  config.step.scale_sigma = 0.03;
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.0, 1e-9), state);
  filter.apply(step(0.0, 1.0, 0.05), state);  // 0.05^2 = 0.03^2 + 0.04^2
  EXPECT_NEAR(state.p(kX, kX), 0.05 * 0.05, 1e-12);
  EXPECT_NEAR(state.p(kX, kScale), 0.03 * 0.03, 1e-12);
  StepEvent second = step(0.0, 1.0, 0.05);
  second.index = 2;
  filter.apply(second, state);
  EXPECT_NEAR(state.p(kX, kX), 0.06 * 0.06 + 2.0 * 0.04 * 0.04, 1e-12);
}

}  // namespace
}  // namespace vpdr::fusion
