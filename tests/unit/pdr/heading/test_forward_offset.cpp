#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "core/rotation.hpp"
#include "pdr/core/heading/carried_axis.hpp"
#include "pdr/core/heading/forward_offset.hpp"
#include "pdr/core/pdr.hpp"
#include "tests/unit/pdr/made_walk.hpp"

namespace vpdr::pdr {
namespace {

using made::Motion;

/// A body that walks (or runs) along `yaw_rad` with `steps_per_s`, swaying sideways as well.
struct Gait {
  double yaw_rad = 0.0;
  double steps_per_s = 1.8;
  double bounce_mps2 = 2.5;
  double surge_mps2 = 1.2;  ///< negative: a runner's
  double sway_mps2 = 1.0;
};

Motion moved_by(const Gait& gait, const EulerAngles& device) {
  Motion motion;
  const double w = 2.0 * kPi * gait.steps_per_s;
  motion.angles = [=](double t) {
    return EulerAngles{device.roll_rad, device.pitch_rad + 0.1 * std::sin(0.5 * w * t),
                       device.yaw_rad + 0.1 * std::cos(0.5 * w * t)};
  };
  motion.upward_mps2 = [=](double t) { return gait.bounce_mps2 * std::cos(w * t); };
  motion.horizontal_mps2 = [=](double t) -> Eigen::Vector2d {
    const double ahead = -gait.surge_mps2 * std::sin(w * t);
    const double left = gait.sway_mps2 * std::cos(0.5 * w * t + 0.7);
    return Eigen::Rotation2Dd(gait.yaw_rad) * Eigen::Vector2d(ahead, left);
  };
  return motion;
}

struct Outcome {
  std::optional<FoundOffset> found;
  int first_step = 0;  ///< with which it was found
};

/// Walks past the estimator with true attitudes, true steps and noisy forces.
void walk(ForwardOffset& forward, const Gait& gait, const EulerAngles& device, int steps,
          Outcome& outcome, TimestampNs start_ns = 0) {
  const double period = 1.0 / gait.steps_per_s;
  made::Readings readings =
      made::read(moved_by(gait, device), steps * period, 100.0, start_ns, false);
  made::add_noise(readings, 0.0, 0.3, 0.0, 5);
  CarriedAxis axis(HeadingConfig{}.turned_over_rad, Carry::kPocket);
  int step = 0;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    const ImuSample& sample = readings.imu[i];
    const Eigen::Quaterniond& q = readings.truth[i];
    axis.add(sample.stamp_ns, q, true);
    forward.add(sample.stamp_ns, q, axis.heading(), sample.specific_force_mps2);
    if (to_seconds(sample.stamp_ns - start_ns) < (step + 1) * period) continue;
    ++step;
    DetectedStep detected;
    detected.stamp_ns = start_ns + to_ns(step * period);
    detected.previous_ns = start_ns + to_ns((step - 1) * period);
    const auto found = forward.take(detected);
    if (found && !outcome.found) outcome.first_step = step;
    if (found) outcome.found = found;
  }
}

Outcome walk(const Gait& gait, const EulerAngles& device, Carry carry, int steps) {
  ForwardOffset forward(ForwardOffsetConfig{}, carry);
  Outcome outcome;
  walk(forward, gait, device, steps, outcome);
  return outcome;
}

TEST(ForwardOffset, FindsWhereThePocketsOwnerGoes) {
  for (const double yaw : {0.0, 1.0, 2.5, -3.0, -1.5}) {
    for (const double pitch : {0.2, -1.4}) {
      const Outcome outcome = walk(Gait{.yaw_rad = yaw}, {0.1, pitch, 0.4}, Carry::kPocket, 24);
      ASSERT_TRUE(outcome.found) << yaw;
      EXPECT_LT(std::abs(wrap_pi(outcome.found->offset_rad - (yaw - 0.4))), 0.15) << yaw << pitch;
      EXPECT_LT(outcome.found->variance_rad2, 0.3);
      EXPECT_LE(outcome.first_step, 17);
    }
  }
}

TEST(ForwardOffset, ADeviceCarriedNobodyKnowsHowTakesMoreToBelieve) {
  const Gait backward{.yaw_rad = 2.8};
  const Outcome unknown = walk(backward, {}, Carry::kUnknown, 40);
  const Outcome hand = walk(backward, {}, Carry::kHand, 40);
  const Outcome pocket = walk(backward, {}, Carry::kPocket, 40);
  ASSERT_TRUE(unknown.found && hand.found && pocket.found);
  EXPECT_LE(pocket.first_step, unknown.first_step);
  EXPECT_LE(unknown.first_step, hand.first_step);
  EXPECT_NEAR(std::abs(unknown.found->offset_rad), 2.8, 0.15);
}

TEST(ForwardOffset, ADeviceThatPointsForwardIsLeftAlone) {
  // A hand's axis lies some 20 degrees off, and so do many: the prior knows better.
  for (const double yaw : {0.0, 0.35, -0.35}) {
    EXPECT_FALSE(walk(Gait{.yaw_rad = yaw}, {}, Carry::kUnknown, 400).found) << yaw;
    EXPECT_FALSE(walk(Gait{.yaw_rad = yaw}, {}, Carry::kHand, 400).found) << yaw;
  }
  EXPECT_FALSE(walk(Gait{.yaw_rad = 2.0}, {}, Carry::kChest, 400).found);
}

TEST(ForwardOffset, AHandHoldsADeviceByOneOfItsFourSides) {
  // The surge is 20 degrees off, as that of recorded hands.
  for (const int quarters : {1, 2, -1}) {
    const double yaw = quarters * 0.5 * kPi - 0.35;
    const Outcome outcome = walk(Gait{.yaw_rad = yaw}, {}, Carry::kHand, 100);
    ASSERT_TRUE(outcome.found) << yaw;
    EXPECT_NEAR(std::abs(wrap_pi(outcome.found->offset_rad - quarters * 0.5 * kPi)), 0.0, 1e-9);
  }
}

TEST(ForwardOffset, TheSideOfADeviceInHandMayChange) {
  ForwardOffset forward(ForwardOffsetConfig{}, Carry::kHand);
  Outcome landscape;
  walk(forward, Gait{.yaw_rad = 0.5 * kPi}, {}, 100, landscape);
  ASSERT_TRUE(landscape.found);
  Outcome portrait;
  walk(forward, Gait{.yaw_rad = 0.0}, {}, 200, portrait, to_ns(100.0));
  ASSERT_TRUE(portrait.found);
  EXPECT_EQ(portrait.found->offset_rad, 0.0);
}

TEST(ForwardOffset, NoiseTellsNothing) {
  // No surge: the direction is that of the noise.
  EXPECT_FALSE(walk(Gait{.surge_mps2 = 0.0}, {}, Carry::kUnknown, 400).found);
}

TEST(ForwardOffset, ARunnersBodyRisesAsItSpeedsUp) {
  const Gait run{.yaw_rad = 2.0, .steps_per_s = 2.8, .bounce_mps2 = 10.0, .surge_mps2 = -2.0};
  const Outcome outcome = walk(run, {}, Carry::kPocket, 40);
  ASSERT_TRUE(outcome.found);
  EXPECT_NEAR(outcome.found->offset_rad, 2.0, 0.15);
}

TEST(ForwardOffset, AHurriedWalkerIsNoRunner) {
  const Gait hurried{.yaw_rad = 2.0, .steps_per_s = 2.5, .bounce_mps2 = 7.5, .surge_mps2 = 2.0};
  const Outcome outcome = walk(hurried, {}, Carry::kPocket, 40);
  ASSERT_TRUE(outcome.found);
  EXPECT_NEAR(outcome.found->offset_rad, 2.0, 0.15);
  EXPECT_FALSE(
      walk(Gait{.steps_per_s = 2.5, .bounce_mps2 = 7.5, .surge_mps2 = 2.0}, {}, Carry::kHand, 400)
          .found);
}

TEST(ForwardOffset, TakenUpAnewNothingOfItIsKnown) {
  ForwardOffset forward(ForwardOffsetConfig{}, Carry::kPocket);
  Outcome outcome;
  walk(forward, Gait{.yaw_rad = 2.5}, {}, 40, outcome);
  ASSERT_TRUE(outcome.found);
  forward.carried_anew(false);
  Outcome later;
  walk(forward, Gait{.yaw_rad = 1.0}, {0.0, -1.4, 0.0}, 40, later, to_ns(30.0));
  ASSERT_TRUE(later.found);
  EXPECT_NEAR(later.found->offset_rad, 1.0, 0.15);
  EXPECT_GT(later.first_step, 4);
}

TEST(ForwardOffset, CarriedOnWhatWasFoundGivesWaySooner) {
  for (const bool carried_on : {false, true}) {
    ForwardOffset forward(ForwardOffsetConfig{}, Carry::kPocket);
    Outcome outcome;
    walk(forward, Gait{.yaw_rad = 2.5}, {}, 80, outcome);
    ASSERT_TRUE(outcome.found);
    if (carried_on) forward.carried_on(0.4);
    Outcome later;
    walk(forward, Gait{.yaw_rad = 1.5}, {}, 40, later, to_ns(60.0));
    ASSERT_TRUE(later.found);
    // Ten windows against twenty, or against four.
    EXPECT_NEAR(later.found->offset_rad, carried_on ? 1.75 : 2.1, 0.2);
  }
}

TEST(ForwardOffset, TakenUpAnewInHandItIsBelievedToPointForwardAsAtFirst) {
  const Gait backward{.yaw_rad = 2.8};
  std::array<int, 2> first_steps{};
  for (const bool carried_on : {false, true}) {
    ForwardOffset forward(ForwardOffsetConfig{}, Carry::kHand);
    if (carried_on) forward.carried_on(0.4);
    forward.carried_anew(true);
    Outcome outcome;
    walk(forward, backward, {}, 60, outcome);
    first_steps[carried_on ? 1 : 0] = outcome.first_step;
  }
  EXPECT_GT(first_steps[0], 0);
  EXPECT_EQ(first_steps[1], first_steps[0]);
}

TEST(ForwardOffset, AStampInTheFutureDoesNotBlockIt) {
  ForwardOffset forward(ForwardOffsetConfig{}, Carry::kPocket);
  const Eigen::Vector3d still(0.0, 0.0, kGravityMps2);
  forward.add(to_ns(1e6), Eigen::Quaterniond::Identity(), Eigen::Vector2d::UnitX(), still);
  Outcome outcome;
  walk(forward, Gait{.yaw_rad = 2.5}, {}, 30, outcome);
  EXPECT_TRUE(outcome.found);
}

TEST(ForwardOffset, TheClockDoesNotMatter) {
  ForwardOffset a(ForwardOffsetConfig{}, Carry::kPocket);
  ForwardOffset b(ForwardOffsetConfig{}, Carry::kPocket);
  Outcome early;
  Outcome late;
  walk(a, Gait{.yaw_rad = 2.5}, {}, 30, early);
  walk(b, Gait{.yaw_rad = 2.5}, {}, 30, late, 1'700'000'000'000'000'000);
  ASSERT_TRUE(early.found && late.found);
  EXPECT_EQ(early.first_step, late.first_step);
  EXPECT_NEAR(early.found->offset_rad, late.found->offset_rad, 1e-6);
}

TEST(Pdr, APhoneThatLiesAcrossThePocketWalksWhereItsOwnerWalks) {
  // The phone's forward axis points north, its owner walks east.
  for (const Carry carry : {Carry::kPocket, Carry::kUnknown}) {
    const Motion motion = moved_by(Gait{.yaw_rad = 0.0}, {0.0, 0.2, 0.5 * kPi});
    const made::Readings readings = made::read(motion, 40.0, 100.0);
    PdrConfig config;
    config.carry = carry;
    Pdr pdr(config);
    PdrOutput output;
    HeadingEstimate heading;
    for (std::size_t i = 0; i < readings.imu.size(); ++i) {
      pdr.process(readings.mag[i]);
      pdr.process(readings.imu[i], output);
      if (output.heading) heading = *output.heading;
    }
    const Eigen::Vector2d end = output.odometry->position_m.head<2>();
    EXPECT_LT(std::abs(std::atan2(end.y(), end.x())), 0.25) << name_of(carry);
    EXPECT_LT(std::abs(heading.yaw_rad), 0.3);
    EXPECT_NEAR(heading.yaw_revision_rad, -0.5 * kPi, 0.4);
    // The device itself is where it is.
    EXPECT_NEAR(yaw_of(output.odometry->world_from_body), 0.5 * kPi, 0.2);
  }
}

}  // namespace
}  // namespace vpdr::pdr
