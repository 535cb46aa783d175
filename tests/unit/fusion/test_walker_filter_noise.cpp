// The correlated errors: what the filter believes of itself must be true (NEES), and vision's rate
// must be worth something.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/rotation.hpp"
#include "fusion/core/walker_filter.hpp"

namespace vpdr::fusion {
namespace {

constexpr double kHeadingPeriod = 0.05;
constexpr double kStepPeriod = 0.5;

HeadingEstimate heading(double at_s, double yaw, double sigma) {
  return {.stamp_ns = to_ns(at_s), .yaw_rad = yaw, .yaw_sigma_rad = sigma};
}

TEST(CorrelatedHeading, ManyHeadingsOfAConstantErrorDoNotMakeItSmall) {
  FusionConfig config;
  config.heading.correlation_time_s = 20.0;
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  for (double t = 0.0; t < 1.0; t += kHeadingPeriod) filter.apply(heading(t, 0.3, 0.1), state);
  const StateVector row = filter.attitude_yaw_row();
  const double sigma = std::sqrt(row.dot(state.p * row));
  EXPECT_NEAR(sigma, 0.1, 0.005);

  config.heading.noise = HeadingNoise::kWhite;
  const WalkerFilter white(config);
  state = white.initial();
  for (double t = 0.0; t < 1.0; t += kHeadingPeriod) white.apply(heading(t, 0.3, 0.1), state);
  EXPECT_LT(std::sqrt(state.p(kYaw, kYaw)), 0.7 * 0.1);  // what S1.10 to the letter believes
}

TEST(CorrelatedHeading, UnconditionalDeviationFollowsWhatPdrReports) {
  FusionConfig config;
  config.heading.white_sigma_rad = 0.0;
  config.heading.bias_sigma_rad = 0.0;
  config.heading.turn_density = 1e6;  // the heading itself says nothing
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  for (const double sigma : {0.1, 0.3, 0.05}) {
    const double at_s = to_seconds(state.stamp_ns) + 0.4;
    filter.apply(heading(at_s, 0.0, sigma), state);
    EXPECT_NEAR(std::sqrt(state.p(kCorrelated, kCorrelated)), sigma, 0.02 * sigma);
  }
}

TEST(CorrelatedHeading, ARevisionOfPdrsZeroCorrectsTheWalkSoFar) {
  FusionConfig config;
  config.heading.white_sigma_rad = 1e-3;
  config.heading.bias_sigma_rad = 0.0;
  config.heading.correlation_time_s = 1e9;
  config.step.scale_sigma = 0.0;
  config.step.direction_sigma_rad = 1e-3;
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  const auto told = [](double at_s, double yaw, double zero_sigma, double revision) {
    return HeadingEstimate{.stamp_ns = to_ns(at_s),
                           .yaw_rad = yaw,
                           .yaw_sigma_rad = zero_sigma,
                           .yaw_zero_sigma_rad = zero_sigma,
                           .yaw_revision_rad = revision};
  };
  filter.apply(told(0.0, 0.0, 0.2, 0.0), state);
  StepEvent step;  // 10 m east
  step.length_m = 10.0;
  step.yaw_sigma_rad = 0.2;
  filter.apply(step, state);
  EXPECT_NEAR(std::sqrt(state.p(kY, kY)), 2.0, 1e-2);
  // pdr learns that its yaw was 0.1 rad too small, good to 0.1 rad now.
  filter.apply(told(0.001, 0.1, 0.1, 0.1), state);
  EXPECT_NEAR(state.x[kYaw], 0.1, 1e-3);
  EXPECT_NEAR(state.x[kY], 1.0, 1e-2);
  EXPECT_NEAR(std::sqrt(state.p(kY, kY)), 1.0, 1e-2);
  EXPECT_NEAR(state.x[kCorrelated], 0.0, 1e-3);
  // Once more, learned as much as was forgotten: the walk turns, its deviation stays.
  filter.apply(told(0.002, 0.15, 0.1, 0.15), state);
  EXPECT_NEAR(state.x[kY], 1.5, 1e-2);
  EXPECT_NEAR(std::sqrt(state.p(kY, kY)), 1.0, 1e-2);
}

TEST(CorrelatedHeading, ALargeRevisionTurnsTheWalkAboutItsStart) {
  const WalkerFilter filter(FusionConfig{});
  FilterState state = filter.initial();
  HeadingEstimate heading{.yaw_rad = 0.0, .yaw_sigma_rad = 1.8, .yaw_zero_sigma_rad = 1.8};
  filter.apply(heading, state);
  StepEvent step;  // 10 m east, as it seems
  step.length_m = 10.0;
  step.yaw_sigma_rad = 1.8;
  filter.apply(step, state);
  // The device points backward: the walk led west, good to 0.2 rad.
  heading.stamp_ns = to_ns(0.05);
  heading.yaw_rad = kPi;
  heading.yaw_sigma_rad = heading.yaw_zero_sigma_rad = 0.2;
  heading.yaw_revision_rad = kPi;
  filter.apply(heading, state);
  EXPECT_NEAR(state.x[kX], -10.0, 0.1);
  EXPECT_NEAR(state.x[kY], 0.0, 0.5);
  EXPECT_NEAR(std::abs(state.x[kYaw]), kPi, 0.05);
  EXPECT_NEAR(std::sqrt(state.p(kY, kY)), 2.0, 0.4);
  EXPECT_NEAR(state.correction_rad, 0.0, 0.05);
}

TEST(ChainedRate, SumOfRatesHoldsTheHeadingWithinOneFrame) {
  // 30 s of frames at 10 Hz with 0.01 rad jitter each, pdr silent for the filter's sake (0.3 rad
  // sigma): the turned angle stays known to about a frame's jitter, not to its random walk.
  FusionConfig config;
  config.rate.drift_density = 0.0;
  config.rate.sway_sigma_rad = 0.0;
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.0, 0.3), state);
  std::mt19937_64 random(7);
  std::normal_distribution<double> jitter(0.0, 0.01);
  double last = jitter(random);
  for (int frame = 1; frame <= 300; ++frame) {
    const double turned = 0.1 * frame * 0.1;  // 0.1 rad/s
    const double seen = turned + jitter(random);
    filter.apply(HeadingRate{.stamp_ns = to_ns(0.1 * frame),
                             .interval_start_ns = to_ns(0.1 * (frame - 1)),
                             .rate_radps = (seen - last) / 0.1,
                             .sigma_radps = 0.01 * std::sqrt(2.0) / 0.1},
                 state);
    last = seen;
  }
  EXPECT_GT(state.rates.accepted, 290U);
  EXPECT_EQ(state.rates.resets, 1U);
  const double turned = wrap_pi(state.x[kYaw] - 3.0);
  EXPECT_NEAR(turned, 0.0, 0.15);  // the first frame, a rate alone, is the largest part
}

TEST(ChainedRate, MissingFrameBeginsANewChain) {
  const WalkerFilter filter{FusionConfig{}};
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.0, 0.1), state);
  const auto frame = [](double from, double to) {
    return HeadingRate{to_ns(to), to_ns(from), 0.0, 0.1};
  };
  filter.apply(frame(0.0, 0.1), state);
  filter.apply(frame(0.1, 0.2), state);
  EXPECT_EQ(state.rates.resets, 1U);
  filter.apply(frame(0.3, 0.4), state);
  EXPECT_EQ(state.rates.resets, 2U);
  EXPECT_EQ(state.rates.gated, 0U);
}

TEST(ChainedRate, JumpOfTheVanishingPointIsRefusedAndForgotten) {
  const WalkerFilter filter{FusionConfig{}};
  FilterState state = filter.initial();
  filter.apply(heading(0.0, 0.0, 0.05), state);
  for (int i = 1; i <= 40; ++i) {
    const double t = 0.05 * i;
    filter.apply(heading(t, 0.0, 0.05), state);
    // Frame 20 sees the side corridor: 90 degrees within one interval.
    const double jump = i == 20 ? kPi / 2.0 / 0.05 : 0.0;
    filter.apply(HeadingRate{to_ns(t), to_ns(t - 0.05), jump, 0.2}, state);
  }
  EXPECT_EQ(state.rates.gated, 1U);
  EXPECT_EQ(state.rates.resets, 2U);
  EXPECT_NEAR(state.x[kYaw], 0.0, 1e-6);
}

/// A walk whose errors are drawn from the very model the filter holds.
struct Drawn {
  double yaw_error = 0.0;
  double yaw_sigma = 0.0;
  double position_nees = 0.0;
};

Drawn walk(std::uint64_t seed, const FusionConfig& config, bool with_vision) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> unit;
  const WalkerFilter filter(config);
  FilterState state = filter.initial();
  const double sigma = 0.1;
  const double white = config.heading.white_sigma_rad;
  const double slow =
      std::sqrt(sigma * sigma - white * white - std::pow(config.heading.bias_sigma_rad, 2));
  const double decay = std::exp(-kHeadingPeriod / config.heading.correlation_time_s);
  const double bias = config.heading.bias_sigma_rad * unit(random);
  const double scale = config.step.scale_sigma * unit(random);
  double correlated = slow * unit(random);
  double yaw = 0.0;
  std::vector<double> yaws;
  const int delay = static_cast<int>(std::lround(config.heading.delay_s / kHeadingPeriod));
  double last_seen = config.rate.sway_sigma_rad * unit(random);
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  for (int i = 0; i <= 1200; ++i) {  // one minute
    const double t = kHeadingPeriod * i;
    const double turn = (i / 200) % 2 == 0 ? 0.0 : 0.3;
    yaw += turn * kHeadingPeriod;
    correlated = decay * correlated + slow * std::sqrt(1.0 - decay * decay) * unit(random);
    const double seen = yaw + config.rate.sway_sigma_rad * unit(random);
    if (with_vision && i > 0) {
      filter.apply(HeadingRate{to_ns(t), to_ns(t - kHeadingPeriod),
                               wrap_pi(seen - last_seen) / kHeadingPeriod, 0.001 / kHeadingPeriod},
                   state);
    }
    last_seen = seen;
    yaws.push_back(yaw);
    const double delayed = yaws[static_cast<std::size_t>(std::max(i - delay, 0))];
    filter.apply(heading(t, wrap_pi(delayed + correlated + bias + white * unit(random)), sigma),
                 state);
    if (i % 10 != 0) continue;
    StepEvent event;
    event.stamp_ns = to_ns(t);
    event.length_m = 0.7;
    event.length_sigma_m = std::hypot(0.05, 0.7 * config.step.scale_sigma);
    event.yaw_rad =
        wrap_pi(yaw + correlated + bias + config.step.direction_sigma_rad * unit(random));
    event.yaw_sigma_rad = sigma;
    filter.apply(event, state);
    const double length = 0.7 * (1.0 + scale) + 0.05 * unit(random);
    const double direction = yaw + config.step.direction_sigma_rad * unit(random);
    position += length * Eigen::Vector2d(std::cos(direction), std::sin(direction));
  }
  const Eigen::Vector2d error = state.x.segment<2>(kX) - position;
  const Eigen::Matrix2d covariance = state.p.block<2, 2>(kX, kX);
  return {wrap_pi(state.x[kYaw] - yaw), std::sqrt(state.p(kYaw, kYaw)),
          error.dot(covariance.ldlt().solve(error))};
}

TEST(Honesty, PositionAndHeadingErrorsAreAsLargeAsTheCovarianceSays) {
  FusionConfig config;
  config.heading.delay_s = 0.25;
  config.rate.drift_density = 0.0;
  for (const bool with_vision : {false, true}) {
    constexpr int kRuns = 60;
    double nees = 0.0;
    double yaw_nees = 0.0;
    int inside = 0;
    for (int run = 0; run < kRuns; ++run) {
      const Drawn drawn = walk(100 + run, config, with_vision);
      nees += drawn.position_nees / kRuns;
      yaw_nees += std::pow(drawn.yaw_error / drawn.yaw_sigma, 2) / kRuns;
      inside += drawn.position_nees < 5.991 ? 1 : 0;  // 95 % of chi-square with 2 dof
    }
    // 60 runs: the mean of chi-square(2) is 2 +- 0.26, of chi-square(1) 1 +- 0.18 (1 sigma).
    EXPECT_NEAR(nees, 2.0, 0.9) << with_vision;
    EXPECT_NEAR(yaw_nees, 1.0, 0.6) << with_vision;
    EXPECT_GE(inside, 52) << with_vision;
  }
}

TEST(Honesty, VisionMakesTheHeadingBetter) {
  FusionConfig config;
  config.heading.bias_sigma_rad = 0.0;
  config.heading.correlation_time_s = 20.0;  // an error that comes and goes: vision averages it
  config.rate.drift_density = 0.0;
  double without = 0.0;
  double with = 0.0;
  for (int run = 0; run < 40; ++run) {
    without += std::pow(walk(500 + run, config, false).yaw_error, 2);
    with += std::pow(walk(500 + run, config, true).yaw_error, 2);
  }
  EXPECT_LT(std::sqrt(with), 0.75 * std::sqrt(without));
}

}  // namespace
}  // namespace vpdr::fusion
