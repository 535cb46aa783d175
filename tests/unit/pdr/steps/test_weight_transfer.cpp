#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "pdr/core/steps/weight_transfer.hpp"
#include "tests/unit/pdr/steps/made_trunk.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Vector3d;

constexpr double kStepS = 0.55;

/// Feeds a board that hangs askew; learns after every step.
std::vector<double> transfers(WeightTransfer& weight, const std::function<Vector3d(double)>& force,
                              double from_s, double to_s, bool walks = true) {
  std::vector<double> instants;
  int steps = 0;
  const int first = static_cast<int>(std::lround(from_s / StepSignal::kPeriodS));
  const int end = static_cast<int>(std::lround(to_s / StepSignal::kPeriodS));
  for (int i = first; i < end; ++i) {
    const double t = i * StepSignal::kPeriodS;
    SignalValue value;
    value.stamp_ns = to_ns(t);
    value.force_mps2 = made::askew() * force(t);
    value.up = made::askew() * Vector3d::UnitZ();
    if (const auto instant = weight.add(value)) instants.push_back(to_seconds(*instant));
    const int now = static_cast<int>((t - from_s) / kStepS);
    if (walks && now > steps) weight.learn(kStepS);
    steps = now;
  }
  return instants;
}

/// Lateral force of 1 m/s^2, zero at 0, 0.55, 1.1 s ... , beside twice as much forward and upward.
Vector3d gait(double t) {
  const double stride = kPi * t / kStepS;
  return {2.0 * std::sin(2.0 * stride), std::sin(stride),
          kGravityMps2 + 2.0 * std::cos(2.0 * stride)};
}

TEST(WeightTransfer, FindsTheAxisAlongWhichEveryStepIsTheOtherWayRound) {
  WeightTransfer weight{StepConfig{}};
  transfers(weight, gait, 0.0, 8.0);
  ASSERT_TRUE(weight.axis());
  EXPECT_GT(std::abs(weight.axis()->dot(made::askew() * Vector3d::UnitY())), 0.995);
}

TEST(WeightTransfer, WhereNothingAlternatesThereIsNoAxis) {
  WeightTransfer weight{StepConfig{}};
  const auto hopping = [](double t) { return Vector3d(gait(t).x(), 0.0, gait(t).z()); };
  EXPECT_TRUE(transfers(weight, hopping, 0.0, 8.0).empty());
  EXPECT_FALSE(weight.axis());
}

TEST(WeightTransfer, TellsWhenTheForceChangesSign) {
  WeightTransfer weight{StepConfig{}};
  transfers(weight, gait, 0.0, 8.0);
  const auto instants = transfers(weight, gait, 8.0, 20.0);
  EXPECT_NEAR(static_cast<double>(instants.size()), 12.0 / kStepS, 2.0);
  for (const double instant : instants) {
    // Half a double support before, and the slow mean leads by 1 / (2 pi 0.91 Hz 2 s) = 0.087 rad,
    // 0.015 s.
    const double steps = (instant + 0.05 + 0.015) / kStepS;
    EXPECT_NEAR(steps, std::round(steps), 0.02 / kStepS) << instant;
  }
}

TEST(WeightTransfer, StandingAndSmallSwayingTransferNothing) {
  WeightTransfer weight{StepConfig{}};
  transfers(weight, gait, 0.0, 8.0);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.3);
  const auto standing = [&](double t) {
    return Vector3d(noise(random), 0.3 * std::sin(2.0 * t) + noise(random),
                    kGravityMps2 + noise(random));
  };
  // What the walk leaves in the filters dies away first.
  transfers(weight, standing, 8.0, 12.0, false);
  EXPECT_TRUE(transfers(weight, standing, 12.0, 72.0, false).empty());
}

TEST(WeightTransfer, AnInterruptionForgetsTheSideButNotTheAxis) {
  WeightTransfer weight{StepConfig{}};
  transfers(weight, gait, 0.0, 8.0);
  weight.restart();
  EXPECT_TRUE(weight.axis());
  EXPECT_NEAR(static_cast<double>(transfers(weight, gait, 100.1, 105.6, false).size()), 9.0, 1.0);
}

}  // namespace
}  // namespace vpdr::pdr
