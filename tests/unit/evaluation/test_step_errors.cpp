#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "evaluation/step_errors.hpp"

namespace vpdr::evaluation {
namespace {

constexpr TimestampNs kMs = 1'000'000;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(MatchSteps, TakesTheClosestPairsFirstAndEachStepOnce) {
  // 1190 is 10 ms from 1200 and goes to it; 1000, 190 ms away, gets the later 1240.
  const auto pairs = match_steps({1000 * kMs, 1200 * kMs, 3000 * kMs},
                                 {1190 * kMs, 1240 * kMs, 2700 * kMs, 3250 * kMs});
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0].truth, 0U);
  EXPECT_EQ(pairs[0].counted, 1U);  // 240 ms away, within the limit
  EXPECT_EQ(pairs[1].counted, 0U);
  EXPECT_EQ(pairs[2].counted, 3U);  // exactly at the limit
}

TEST(MatchSteps, NeverPairsBeyondTheLimitNorTwice) {
  std::mt19937 random(11);
  std::uniform_int_distribution<TimestampNs> gap(50 * kMs, 700 * kMs);
  for (int round = 0; round < 20; ++round) {
    std::vector<TimestampNs> a{0};
    std::vector<TimestampNs> b{30 * kMs};
    for (int i = 0; i < 100; ++i) {
      a.push_back(a.back() + gap(random));
      b.push_back(b.back() + gap(random));
    }
    std::vector<bool> used(b.size(), false);
    const auto pairs = match_steps(a, b);
    EXPECT_FALSE(pairs.empty());
    for (const StepPair& pair : pairs) {
      EXPECT_LE(std::abs(a[pair.truth] - b[pair.counted]), kStepMatchNs);
      EXPECT_FALSE(used[pair.counted]);
      used[pair.counted] = true;
    }
  }
}

RunDirectory run_with(const std::vector<TimestampNs>& stamps_ms, double length_m = 0.7) {
  RunDirectory run;
  for (const TimestampNs stamp : stamps_ms) run.steps.push_back({stamp * kMs, length_m, 0.0});
  return run;
}

TEST(StepErrors, ComparesCountsInstantsAndLengths) {
  dataset::Recording recording;
  recording.truth.steps = {
      {500 * kMs, kNan}, {1000 * kMs, 0.8}, {1500 * kMs, 0.6}, {2000 * kMs, 0.6}};
  const auto errors = step_errors(run_with({540, 1060, 1540, 2600, 3000}), recording);
  ASSERT_TRUE(errors.has_value());
  EXPECT_EQ(errors->truth, 4U);
  EXPECT_EQ(errors->counted, 5U);
  EXPECT_DOUBLE_EQ(errors->error_percent, 25.0);
  ASSERT_TRUE(errors->timing.has_value());
  EXPECT_EQ(errors->timing->matched, 3U);
  EXPECT_DOUBLE_EQ(errors->timing->recall_percent, 75.0);
  EXPECT_DOUBLE_EQ(errors->timing->precision_percent, 60.0);
  // Offsets 40, 60, 40 ms: mean 46.67, sigma sqrt((1600+3600+1600)/3 - 46.67^2) = 9.43 ms.
  EXPECT_NEAR(errors->timing->mean_offset_s, 0.046667, 1e-6);
  EXPECT_NEAR(errors->timing->sigma_s, 0.009428, 1e-6);
  // Lengths 0.7 against 0.8 and 0.6: no bias, RMSE 0.1.
  EXPECT_NEAR(*errors->timing->length_bias_percent, 0.0, 1e-9);
  EXPECT_NEAR(*errors->timing->length_rmse_m, 0.1, 1e-12);
}

TEST(StepErrors, ACountAloneIsEnough) {
  dataset::Recording recording;
  recording.about.true_steps = 100.0;
  RunDirectory run;
  run.steps.resize(93);
  const auto errors = step_errors(run, recording);
  EXPECT_DOUBLE_EQ(errors->error_percent, 7.0);
  EXPECT_FALSE(errors->timing.has_value());
}

TEST(StepErrors, CountsOnlyInsideTheBoutsTheReferenceSaw) {
  dataset::Recording recording;
  recording.truth.steps = {{5000 * kMs, kNan}, {5500 * kMs, kNan}};
  recording.truth.walking_bouts = {{{5000 * kMs, 5500 * kMs}}};
  const auto errors = step_errors(run_with({1000, 2000, 4800, 5100, 5600, 9000}), recording);
  EXPECT_EQ(errors->truth, 2U);
  EXPECT_EQ(errors->counted, 3U);  // 4800 is within a quarter of a second of the bout
  EXPECT_DOUBLE_EQ(errors->timing->precision_percent, 100.0 * 2 / 3);
}

TEST(StepErrors, NoTruthIsNoFigure) {
  EXPECT_FALSE(step_errors(run_with({1, 2}), dataset::Recording{}).has_value());
}

}  // namespace
}  // namespace vpdr::evaluation
