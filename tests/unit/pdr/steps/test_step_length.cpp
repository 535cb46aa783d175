#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/rotation.hpp"
#include "pdr/core/steps/step_length.hpp"

namespace vpdr::pdr {
namespace {

StepLengthModel model_of(StepLengthKind kind, double height_m = 0.0, StepLengthConfig config = {}) {
  config.model = kind;
  return {config, height_m, Carry::kUnknown};
}

TEST(StepLength, LinearInFrequency) {
  StepLengthConfig config;
  config.alpha_m_per_hz = 0.3;
  config.beta_m = 0.1;
  const StepLengthModel model = model_of(StepLengthKind::kLinear, 0.0, config);
  // S1.2 with t_k - t_(k-1) = 0.5 s: 0.3 / 0.5 + 0.1.
  EXPECT_DOUBLE_EQ(model.length({1.0 / 0.5, 7.0}).length_m, 0.7);
  EXPECT_DOUBLE_EQ(model.length({1.0, 3.0}).length_m, 0.4);
  // The default is the walk ratio, 0.385 m/Hz at 1.8 Hz.
  EXPECT_NEAR(model_of(StepLengthKind::kLinear).length({1.8, 5.0}).length_m, 0.693, 1e-12);
}

TEST(StepLength, WeinbergIsTheFourthRootOfTheSwing) {
  // S1.12: 0.4 x 16^(1/4).
  EXPECT_DOUBLE_EQ(weinberg_length_m(0.4, 16.0), 0.8);
  StepLengthConfig config;
  config.weinberg_k = 0.4;
  const StepLengthModel model = model_of(StepLengthKind::kWeinberg, 0.0, config);
  EXPECT_DOUBLE_EQ(model.length({1.2, 16.0}).length_m, 0.8);
  EXPECT_DOUBLE_EQ(model.length({2.4, 16.0}).length_m, 0.8);
}

TEST(StepLength, FuzzyWeightsSumToOne) {
  for (const double swing : {0.0, 1.0, 2.0, 3.5, 5.0, 7.0, 10.0, 30.0}) {
    const auto a = fuzzy_weights(swing);
    EXPECT_NEAR(std::accumulate(a.begin(), a.end(), 0.0), 1.0, 1e-12) << swing;
    for (const double weight : a) EXPECT_GE(weight, 0.0);
  }
  EXPECT_EQ(fuzzy_weights(1.0)[0], 1.0);
  EXPECT_EQ(fuzzy_weights(5.0)[1], 1.0);
  EXPECT_NEAR(fuzzy_weights(3.5)[0], 0.5, 1e-12);
  EXPECT_EQ(fuzzy_weights(20.0)[2], 1.0);
}

TEST(StepLength, FuzzyDecisionByHand) {
  // S3.2 for a person whose normal step is the paper's 0.40 m.
  // Low: B = (0.8, 0.2, 0): 0.8 x 0.30 + 0.2 x 0.40.
  EXPECT_NEAR(fuzzy_length_m(1.0, 0.40), 0.32, 1e-12);
  // Normal: B = (0.1, 0.8, 0.1): 0.03 + 0.32 + 0.05.
  EXPECT_NEAR(fuzzy_length_m(5.0, 0.40), 0.40, 1e-12);
  // High: B = (0, 0.2, 0.8): 0.08 + 0.40.
  EXPECT_NEAR(fuzzy_length_m(12.0, 0.40), 0.48, 1e-12);
  // Half low, half normal: B = (0.45, 0.5, 0.05): 0.135 + 0.2 + 0.025.
  EXPECT_NEAR(fuzzy_length_m(3.5, 0.40), 0.36, 1e-12);
  EXPECT_NEAR(fuzzy_length_m(3.5, 0.80), 0.72, 1e-12) << "scales with the person";
}

TEST(StepLength, PendulumByHand) {
  // 2 pi f = 10 1/s, swing 4 m/s^2: falls by 0.04 m; 2 sqrt(2 x 0.9 x 0.04).
  EXPECT_NEAR(pendulum_length_m(10.0 / (2.0 * kPi), 4.0, 0.9), 2.0 * std::sqrt(0.072), 1e-12);
  EXPECT_EQ(pendulum_length_m(1.8, -1.0, 0.9), 0.0);
}

TEST(StepLength, CombinedLiesBetweenItsParts) {
  StepLengthConfig config;
  config.linear_sigma = config.weinberg_sigma = config.unknown_sigma = 0.1;
  const double f = 10.0 / (2.0 * kPi);
  const double linear = 0.385 * f;
  const double weinberg = 0.41 * std::pow(4.0, 0.25);
  const double pendulum = config.pendulum_factor * pendulum_length_m(f, 4.0, 0.53 * 1.7);
  // Equal weights: the geometric mean.
  EXPECT_NEAR(model_of(StepLengthKind::kCombined, 0.0, config).length({f, 4.0}).length_m,
              std::cbrt(linear * weinberg * pendulum), 1e-12);
  config.unknown_sigma = 0.01;  // a hundred times the weight of the others
  EXPECT_NEAR(model_of(StepLengthKind::kCombined, 0.0, config).length({f, 4.0}).length_m, pendulum,
              0.01);
}

TEST(StepLength, GrowsWithHeightAndIsThatOfAnAverageAdultWithout) {
  for (const auto kind :
       {StepLengthKind::kCombined, StepLengthKind::kWeinberg, StepLengthKind::kFuzzy}) {
    const double unknown = model_of(kind).length({1.8, 6.0}).length_m;
    EXPECT_NEAR(model_of(kind, 1.7).length({1.8, 6.0}).length_m, unknown, 1e-12);
    // In proportion; the pendulum's part by the root.
    const double tall = model_of(kind, 1.87).length({1.8, 6.0}).length_m;
    EXPECT_GE(tall, (kind == StepLengthKind::kCombined ? std::sqrt(1.1) : 1.1 - 1e-9) * unknown);
    EXPECT_LE(tall, (1.1 + 1e-9) * unknown);
  }
}

TEST(StepLength, TheSameBounceIsALongerStepOnTheHeadThanInTheHand) {
  const auto length = [](Carry carry) {
    return StepLengthModel({}, 0.0, carry).length({1.7, 4.0}).length_m;
  };
  EXPECT_EQ(length(Carry::kPocket), length(Carry::kHand));
  EXPECT_GT(length(Carry::kWaist), length(Carry::kHand));
  EXPECT_EQ(length(Carry::kWaist), length(Carry::kChest));
  EXPECT_GT(length(Carry::kHead), length(Carry::kWaist));
}

TEST(StepLength, WhoMarchesOnTheSpotGetsNowhere) {
  StepLengthConfig config;
  config.linear_sigma = config.weinberg_sigma = 0.9999;
  config.pendulum_sigma = 0.0001;  // the pendulum alone
  config.shortest_m = 0.01;
  const StepLengthModel waist(config, 0.0, Carry::kWaist);
  const auto pendulum_m = [&](double swing_mps2) {
    return config.pendulum_on_trunk * pendulum_length_m(1.8, swing_mps2, 0.53 * 1.7);
  };
  EXPECT_NEAR(waist.length({1.8, 5.0}).length_m, pendulum_m(5.0), 1e-6);
  EXPECT_NEAR(waist.length({1.8, 4.0}).length_m, pendulum_m(4.0), 1e-6);
  // 4 (2.5 - 1.5) / 2.5 = 1.6; of less a tenth is left.
  EXPECT_NEAR(waist.length({1.8, 2.5}).length_m, pendulum_m(1.6), 1e-6);
  EXPECT_NEAR(waist.length({1.8, 1.5}).length_m, pendulum_m(0.15), 1e-6);
  // An arm takes of the bounce, so that it does not tell.
  const StepLengthModel hand(config, 0.0, Carry::kHand);
  EXPECT_NEAR(hand.length({1.8, 2.5}).length_m / hand.length({1.8, 5.0}).length_m, std::sqrt(0.5),
              1e-6);
  config.marching_mps2 = 100.0;
  EXPECT_GT(StepLengthModel(config, 0.0, Carry::kWaist).length({1.8, 4.0}).length_m, 0.3);
}

TEST(StepLength, LearnsTheScaleFromFiveDistances) {
  // S1.13: K = L / s^(1/4), s = 16: distances 0.8, 0.9, 0.7, 0.85, 0.75 give K = 0.4 in the mean.
  StepLengthConfig config;
  config.weinberg_k = 0.5;
  StepLengthModel model = model_of(StepLengthKind::kWeinberg, 0.0, config);
  EXPECT_NEAR(model.length({1.8, 16.0}).length_m, 1.0, 1e-12);
  EXPECT_EQ(model.length({1.8, 16.0}).scale_sigma, config.unknown_scale_sigma);
  for (const double distance : {0.8, 0.9, 0.7, 0.85}) {
    model.learn_from_distance(distance, {1.8, 16.0});
    EXPECT_EQ(model.scale(), 1.0) << "of five, not before";
  }
  model.learn_from_distance(0.75, {1.8, 16.0});
  EXPECT_NEAR(model.scale() * config.weinberg_k, 0.4, 1e-12);
  EXPECT_NEAR(model.length({1.8, 81.0}).length_m, 1.2, 1e-12);
  EXPECT_EQ(model.length({1.8, 16.0}).scale_sigma, config.learned_sigma);
  // Refreshed: five of 1.0 m make K 0.5 again. What no step can be is left out.
  model.learn_from_distance(0.0, {1.8, 16.0});
  model.learn_from_distance(5.0, {1.8, 16.0});
  model.learn_from_distance(std::nan(""), {1.8, 16.0});
  for (int i = 0; i < 5; ++i) model.learn_from_distance(1.0, {1.8, 16.0});
  EXPECT_NEAR(model.scale(), 1.0, 1e-12);
}

TEST(StepLength, StaysWithinItsRange) {
  const StepLengthConfig config;
  for (const auto kind : {StepLengthKind::kCombined, StepLengthKind::kLinear}) {
    const StepLengthModel model = model_of(kind);
    EXPECT_DOUBLE_EQ(model.length({0.1, 0.0}).length_m, config.shortest_m);
    EXPECT_DOUBLE_EQ(model.length({9.0, 4000.0}).length_m, config.longest_m);
  }
}

TEST(StepLength, SigmaHoldsPersonAndStep) {
  StepLengthConfig config;
  config.unknown_scale_sigma = 0.03;
  config.step_sigma = 0.04;
  const StepLength step = model_of(StepLengthKind::kLinear, 0.0, config).length({2.0, 6.0});
  EXPECT_NEAR(step.sigma_m, 0.77 * 0.05, 1e-12);
  EXPECT_EQ(step.scale_sigma, 0.03);
}

TEST(StepLength, OnStairsTheTreadGivesIt) {
  StepLengthConfig config;
  config.model = StepLengthKind::kLinear;
  config.unknown_scale_sigma = 0.0;
  const StepLengthModel model(config, 0.0, Carry::kUnknown);
  const double level_m = 0.385 * 2.0;
  EXPECT_NEAR(model.length({2.0, 5.0, 0.0}).length_m, level_m, 1e-12);
  EXPECT_NEAR(model.length({2.0, 5.0, 1.0}).length_m, 0.29, 1e-12);
  EXPECT_NEAR(model.length({2.0, 5.0, 1.0}).sigma_m, 0.029, 1e-12);
  // At even odds: the mean of both, unsure by half their difference.
  const StepLength open = model.length({2.0, 5.0, 0.5});
  EXPECT_NEAR(open.length_m, 0.53, 1e-12);
  EXPECT_NEAR(open.sigma_m, std::hypot(0.053, 0.24), 1e-12);
}

TEST(StepLength, WhoSetsOffHasGoneLittleMoreThanHalfAStep) {
  StepLengthConfig config;
  config.first_share = 0.6;
  StepLengthModel model(config, 0.0, Carry::kHand);
  const double step_m = model.length({1.8, 5.0}).length_m;
  const StepShape first{.frequency_hz = 1.8, .swing_mps2 = 5.0, .sets_off = true};
  EXPECT_NEAR(model.length(first).length_m, 0.6 * step_m, 1e-12);
  EXPECT_NEAR(model.length(first).noise_m, 0.4 * 0.6 * step_m, 1e-12);
  // What is learned from it is the person's scale, as from any other.
  for (int i = 0; i < 5; ++i) model.learn_from_distance(1.1 * 0.6 * step_m, first);
  EXPECT_NEAR(model.scale(), 1.1, 1e-12);
}

TEST(StepLength, WhoTurnsTakesShorterSteps) {
  const StepLengthConfig config;
  const StepLengthModel waist(config, 0.0, Carry::kWaist);
  const double straight_m = waist.length({1.8, 5.0}).length_m;
  const auto turning_m = [&](double turn_rad) {
    return waist.length({1.8, 5.0, 0.0, turn_rad}).length_m;
  };
  // cos 60 degrees, to either side.
  EXPECT_NEAR(turning_m(kPi / 3.0), 0.5 * straight_m, 1e-12);
  EXPECT_NEAR(turning_m(-kPi / 3.0), 0.5 * straight_m, 1e-12);
  // Not backwards, however far.
  EXPECT_EQ(turning_m(kPi), turning_m(1.2));
  // A tread is as deep in a winding staircase; a head turns without its owner.
  EXPECT_NEAR(waist.length({1.8, 5.0, 1.0, kPi / 3.0}).length_m, config.tread_m, 1e-12);
  const StepLengthModel head(config, 0.0, Carry::kHead);
  EXPECT_EQ(head.length({1.8, 5.0, 0.0, 1.0}).length_m, head.length({1.8, 5.0}).length_m);
}

TEST(StepLength, TheSourcesModelsAreAsPrintedInTurns) {
  for (const auto kind :
       {StepLengthKind::kLinear, StepLengthKind::kWeinberg, StepLengthKind::kFuzzy}) {
    StepLengthConfig config;
    config.model = kind;
    const StepLengthModel waist(config, 0.0, Carry::kWaist);
    EXPECT_EQ(waist.length({1.8, 5.0, 0.0, 1.0}).length_m, waist.length({1.8, 5.0}).length_m);
  }
}

TEST(StepLength, LearnsFromTurningStepsWhatItWouldFromStraightOnes) {
  StepLengthModel waist(StepLengthConfig{}, 0.0, Carry::kWaist);
  const double straight_m = waist.length({1.8, 5.0}).length_m;
  for (int i = 0; i < 5; ++i) {
    waist.learn_from_distance(0.5 * 1.1 * straight_m, {1.8, 5.0, 0.0, kPi / 3.0});
  }
  EXPECT_NEAR(waist.scale(), 1.1, 1e-12);
}

}  // namespace
}  // namespace vpdr::pdr
