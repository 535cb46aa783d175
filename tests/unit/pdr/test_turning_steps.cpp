// How long the steps are of somebody who turns.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/rotation.hpp"
#include "pdr/core/pdr.hpp"
#include "tests/unit/pdr/made_walk.hpp"

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

/// A hand that hangs, further.
double swinging(double t) { return 0.4 * std::sin(kPi * kStepsPerSecond * t); }

/// The lengths of that walk from step `first` on are `share` of those straight ahead.
void expect_share(const std::function<double(double)>& yaw_rad, Carry carry, std::size_t first,
                  double share, double tolerance) {
  const auto ahead = step_lengths(straight, carry);
  const auto other = step_lengths(yaw_rad, carry);
  ASSERT_GT(ahead.size(), 30U);
  ASSERT_EQ(other.size(), ahead.size());
  for (std::size_t i = first; i < ahead.size(); ++i) {
    EXPECT_NEAR(other[i] / ahead[i], share, tolerance) << "step " << i;
  }
}

TEST(TurningSteps, AreShorter) {
  expect_share(circle, Carry::kWaist, 1, std::cos(0.25), 2e-3);
  expect_share(circle, Carry::kHand, 1, std::cos(0.25), 2e-3);
}

TEST(TurningSteps, AreNotByAHeadThatLooksAbout) {
  expect_share(circle, Carry::kHead, 0, 1.0, 1e-3);
}

TEST(TurningSteps, ASwayingPelvisIsNoTurn) { expect_share(swaying, Carry::kWaist, 2, 1.0, 2e-3); }

TEST(TurningSteps, AnArmThatSwingsIsNoTurn) {
  expect_share(swinging, Carry::kUnknown, 2, 1.0, 1e-2);
}

}  // namespace
}  // namespace vpdr::pdr
