// How long the steps are of somebody who turns.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/rotation.hpp"
#include "made_walk.hpp"
#include "pdr/core/pdr.hpp"

namespace vpdr::pdr {
namespace {

constexpr double kStepsPerSecond = 1.8;

/// Lengths of the confirmed steps of a walk of 20 s whose yaw is that at t.
std::vector<double> step_lengths(const std::function<double(double)>& yaw_rad, Carry carry) {
  made::Motion motion;
  motion.angles = [&](double t) { return EulerAngles{0.0, 0.0, yaw_rad(t)}; };
  motion.upward_mps2 = made::bounce(kStepsPerSecond);
  PdrConfig config;
  config.carry = carry;
  Pdr pdr(config);
  PdrOutput output;
  std::vector<double> lengths;
  for (const ImuSample& sample : made::read(motion, 20.0, 100.0).imu) {
    pdr.process(sample, output);
    if (output.step && output.step->status == StepStatus::kConfirmed) {
      lengths.push_back(output.step->length_m);
    }
  }
  return lengths;
}

double straight(double) { return 0.0; }
double circle(double t) { return 0.25 * kStepsPerSecond * t; }
/// The pelvis, forth with one leg and back with the other.
double swaying(double t) { return 0.15 * std::sin(kPi * kStepsPerSecond * t); }

TEST(TurningSteps, AreShorterOnTheTrunk) {
  const auto ahead = step_lengths(straight, Carry::kWaist);
  const auto around = step_lengths(circle, Carry::kWaist);
  ASSERT_GT(ahead.size(), 30U);
  ASSERT_EQ(around.size(), ahead.size());
  for (std::size_t i = 1; i < ahead.size(); ++i) {
    EXPECT_NEAR(around[i] / ahead[i], std::cos(0.25), 2e-3) << "step " << i;
  }
}

TEST(TurningSteps, AreNotOfAPhoneInTheHand) {
  const auto ahead = step_lengths(straight, Carry::kHand);
  const auto around = step_lengths(circle, Carry::kHand);
  ASSERT_GT(ahead.size(), 30U);
  ASSERT_EQ(around.size(), ahead.size());
  for (std::size_t i = 0; i < ahead.size(); ++i) EXPECT_NEAR(around[i], ahead[i], 1e-3);
}

TEST(TurningSteps, ASwayingPelvisIsNoTurn) {
  const auto ahead = step_lengths(straight, Carry::kWaist);
  const auto sway = step_lengths(swaying, Carry::kWaist);
  ASSERT_GT(ahead.size(), 30U);
  ASSERT_EQ(sway.size(), ahead.size());
  for (std::size_t i = 2; i < ahead.size(); ++i) {
    EXPECT_NEAR(sway[i] / ahead[i], 1.0, 2e-3) << "step " << i;
  }
}

}  // namespace
}  // namespace vpdr::pdr
