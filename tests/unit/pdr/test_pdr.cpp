#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/rotation.hpp"
#include "pdr/core/pdr.hpp"
#include "tests/unit/pdr/made_walk.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using made::Motion;
using made::Readings;

/// Walks north for 30 s from 2 s on, then east; 1.8 steps/s.
Motion north_then_east() {
  Motion motion;
  motion.angles = [](double t) {
    const double turned = std::clamp((t - 32.0) / 1.5, 0.0, 1.0);
    return EulerAngles{0.02 * std::sin(5.65 * t), 0.1,
                       0.5 * kPi * (1.0 - turned) + 0.04 * std::sin(5.65 * t)};
  };
  motion.upward_mps2 = [](double t) {
    return t < 2.0 || t > 63.0 ? 0.0 : 3.0 * std::cos(2.0 * kPi * 1.8 * (t - 2.0));
  };
  return motion;
}

/// Steps of 0.385 m/Hz whatever their bounce.
PdrConfig with_linear_steps() {
  PdrConfig config;
  config.step_length.model = StepLengthKind::kLinear;
  return config;
}

struct Walk {
  std::vector<StepEvent> steps;  ///< confirmed
  std::vector<StepEvent> words;  ///< all that was said of steps
  std::vector<HeadingEstimate> headings;
  PoseEstimate last;
  int odometry = 0;
  int attitudes = 0;
};

Walk run(Pdr& pdr, const Readings& readings) {
  Walk walk;
  PdrOutput output;
  std::size_t mag = 0;
  for (const ImuSample& sample : readings.imu) {
    while (mag < readings.mag.size() && readings.mag[mag].stamp_ns <= sample.stamp_ns) {
      pdr.process(readings.mag[mag++]);
    }
    if (pdr.process(sample, output) != Refusal::kNone) continue;
    if (output.step) walk.words.push_back(*output.step);
    if (output.step && output.step->status == StepStatus::kConfirmed) {
      walk.steps.push_back(*output.step);
    }
    if (output.heading) walk.headings.push_back(*output.heading);
    if (output.attitude) ++walk.attitudes;
    if (output.odometry) {
      ++walk.odometry;
      walk.last = *output.odometry;
    }
  }
  return walk;
}

TEST(Pdr, WalksNorthThenEast) {
  Pdr pdr(with_linear_steps());
  const Readings readings = made::read(north_then_east(), 65.0, 100.0);
  const Walk walk = run(pdr, readings);
  const double step_m = 0.385 * 1.8;
  EXPECT_NEAR(static_cast<double>(walk.steps.size()), 109.0, 2.0);
  EXPECT_EQ(walk.steps.front().index, 1U);
  EXPECT_EQ(walk.steps.back().index, walk.steps.size());
  // 55 steps north, the 1.5 s of the turn (2.7 steps, 2 / pi of them in each direction), 53 east.
  EXPECT_NEAR(walk.last.position_m.y(), (55.0 + 1.7) * step_m, 1.0);
  EXPECT_NEAR(walk.last.position_m.x(), (53.0 + 1.7) * step_m, 1.0);
  EXPECT_NEAR(to_degrees(walk.steps[20].yaw_rad), 90.0, 1.5);
  EXPECT_NEAR(to_degrees(walk.steps.back().yaw_rad), 0.0, 1.5);
  EXPECT_NEAR(walk.steps[20].length_m, step_m, 0.02);
}

TEST(Pdr, SpeaksWithEverySampleAndHeadingOnSchedule) {
  Pdr pdr;
  const Readings readings = made::read(north_then_east(), 65.0, 100.0);
  const Walk walk = run(pdr, readings);
  EXPECT_EQ(walk.odometry, static_cast<int>(readings.imu.size()));
  EXPECT_EQ(walk.attitudes, static_cast<int>(readings.imu.size()));
  // Every 50 ms, and with each step that falls between.
  EXPECT_GE(walk.headings.size(), 1300U);
  EXPECT_LE(walk.headings.size(), 1301U + walk.steps.size());
  for (const HeadingEstimate& h : walk.headings) EXPECT_TRUE(std::isfinite(h.yaw_rad));
}

TEST(Pdr, AWalkThatBeginsIsFollowedBeforeItIsKnown) {
  // 1.8 steps/s of 0.693 m north from 2 s on. Four are needed to know the walk, 2.8 m; with their
  // probabilities 0.5, 0.7, 0.8 the first three are worth 2 steps of 3, the step under way is less
  // than one more.
  Pdr pdr(with_linear_steps());
  const Readings readings = made::read(north_then_east(), 12.0, 100.0);
  PdrOutput output;
  double last = 0.0;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    pdr.process(readings.mag[i]);
    pdr.process(readings.imu[i], output);
    const double t = to_seconds(readings.imu[i].stamp_ns);
    const double truth = std::max(0.0, (t - 2.0) * 1.8 * 0.385 * 1.8);
    const double north = output.odometry->position_m.y();
    EXPECT_NEAR(north, truth, 2.1) << t;
    EXPECT_LT(std::abs(north - last), 1.1) << t;
    const double sigma = std::sqrt(output.odometry->covariance(1, 1));
    EXPECT_LT(std::abs(north - truth), 3.3 * sigma) << t;
    last = north;
  }
  EXPECT_GT(pdr.step_count(), 14U);
}

TEST(Pdr, SaysEachStepAtOnceAndOnceForAll) {
  Pdr pdr;
  const Readings readings = made::read(north_then_east(), 20.0, 100.0);
  const Walk walk = run(pdr, readings);
  // The first three wait for the fourth, then all are said to be steps, under the same numbers.
  ASSERT_GT(walk.words.size(), 8U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(walk.words[i].status, StepStatus::kTentative);
    EXPECT_EQ(walk.words[i].index, i + 1);
    EXPECT_EQ(walk.words[i + 3].status, StepStatus::kConfirmed);
    EXPECT_EQ(walk.words[i + 3].stamp_ns, walk.words[i].stamp_ns);
    EXPECT_EQ(walk.words[i + 3].index, i + 1);
  }
  EXPECT_EQ(walk.words[6].index, 4U);
  EXPECT_EQ(walk.words[6].probability, 1.0);
}

TEST(Pdr, WhatWasNoStepIsTakenBack) {
  Motion knock;
  knock.upward_mps2 = [](double t) {
    const double from_peak = (t - 5.0) / 0.1;
    return 4.0 * std::exp(-0.5 * from_peak * from_peak);
  };
  Pdr pdr;
  PdrOutput output;
  const Readings readings = made::read(knock, 15.0, 100.0);
  double furthest = 0.0;
  std::vector<StepEvent> words;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    pdr.process(readings.mag[i]);
    pdr.process(readings.imu[i], output);
    if (output.step) words.push_back(*output.step);
    furthest = std::max(furthest, output.odometry->position_m.head<2>().norm());
  }
  ASSERT_EQ(words.size(), 2U);
  EXPECT_EQ(words[0].status, StepStatus::kTentative);
  EXPECT_EQ(words[1].status, StepStatus::kWithdrawn);
  EXPECT_EQ(words[1].stamp_ns, words[0].stamp_ns);
  EXPECT_NEAR(furthest, words[0].probability * words[0].length_m, 1e-9);
  EXPECT_TRUE(output.odometry->position_m.isZero());
  EXPECT_EQ(pdr.step_count(), 0U);
}

TEST(Pdr, CovarianceGrowsWithTheWay) {
  Pdr pdr;
  Readings readings = made::read(north_then_east(), 65.0, 100.0);
  PdrOutput output;
  double first = 0.0;
  double last = 0.0;
  std::size_t mag = 0;
  for (const ImuSample& sample : readings.imu) {
    pdr.process(readings.mag[mag++]);
    pdr.process(sample, output);
    const Matrix6d& p = output.odometry->covariance;
    EXPECT_TRUE(p.isApprox(p.transpose(), 1e-9));
    EXPECT_GE(p.ldlt().vectorD().minCoeff(), -1e-12);
    if (output.step && output.step->status == StepStatus::kConfirmed &&
        output.step->index % 20 == 0) {
      const double spread = p(0, 0) + p(1, 1);
      if (first == 0.0) first = spread;
      last = spread;
    }
  }
  EXPECT_GT(first, 1.0);         // 14 m with a scale good to 10 % and a heading to some degrees
  EXPECT_GT(last, 3.0 * first);  // five times the way, while the field tells more of the heading
}

TEST(Pdr, RefusesBadSamplesAndGoesOnAsIfTheyHadNotCome) {
  const Readings readings = made::read(north_then_east(), 20.0, 100.0);
  Pdr clean;
  Pdr dirty;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  PdrOutput a;
  PdrOutput b;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    clean.process(readings.mag[i]);
    clean.process(readings.imu[i], a);
    ImuSample bad = readings.imu[i];
    bad.stamp_ns += 1000;
    bad.specific_force_mps2.x() = nan;
    EXPECT_EQ(dirty.process(bad, b), Refusal::kNonFinite);
    EXPECT_FALSE(b.attitude || b.step || b.heading || b.odometry);
    EXPECT_EQ(dirty.process(MagSample{readings.mag[i].stamp_ns, {nan, 0.0, 0.0}}),
              Refusal::kNonFinite);
    dirty.process(readings.mag[i]);
    dirty.process(readings.imu[i], b);
    EXPECT_EQ(dirty.process(readings.imu[i], b), Refusal::kDuplicate);
  }
  EXPECT_EQ(clean.step_count(), dirty.step_count());
  EXPECT_EQ(clean.dead_reckoning().position_m(), dirty.dead_reckoning().position_m());
  EXPECT_EQ(dirty.imu_gate().refused(Refusal::kNonFinite), readings.imu.size());
  EXPECT_GT(dirty.step_count(), 20U);
}

TEST(Pdr, AFarFutureStampDoesNotBlockIt) {
  const Readings readings = made::read(north_then_east(), 20.0, 100.0);
  for (const std::size_t where : {std::size_t{0}, std::size_t{500}}) {
    Readings jumped = readings;
    jumped.imu[where].stamp_ns += 1'000'000'000'000'000;
    Pdr pdr;
    const Walk walk = run(pdr, jumped);
    EXPECT_GE(walk.odometry, static_cast<int>(readings.imu.size()) - 2);
    EXPECT_NEAR(static_cast<double>(walk.steps.size()), 32.0, 2.0) << where;
    EXPECT_GT(walk.headings.size(), 390U) << where;
  }
}

TEST(Pdr, ALateFieldTurnsTheTrackAboutItsStart) {
  Readings readings = made::read(north_then_east(), 30.0, 100.0);
  std::erase_if(readings.mag, [](const MagSample& m) { return m.stamp_ns < to_ns(20.0); });
  Pdr pdr(with_linear_steps());
  const Walk walk = run(pdr, readings);
  EXPECT_NEAR(walk.last.position_m.x(), 0.0, 1.0);
  EXPECT_NEAR(walk.last.position_m.y(), 50.0 * 0.693, 1.5);
  EXPECT_FALSE(walk.headings[100].yaw_is_absolute);
  EXPECT_TRUE(walk.headings.back().yaw_is_absolute);
}

TEST(Pdr, CountsStepsOfAnAccelerometerAlone) {
  Readings readings = made::read(north_then_east(), 65.0, 100.0, 0, false);
  for (ImuSample& s : readings.imu) {
    s.angular_velocity_radps.setZero();
    s.has_angular_velocity = false;
  }
  Pdr pdr(with_linear_steps());
  const Walk walk = run(pdr, readings);
  EXPECT_NEAR(static_cast<double>(walk.steps.size()), 109.0, 2.0);
  EXPECT_GT(walk.steps.back().yaw_sigma_rad, 1.0);
}

TEST(Pdr, TheClockOfTheSamplesDoesNotMatter) {
  Pdr a;
  Pdr b;
  run(a, made::read(north_then_east(), 40.0, 100.0));
  run(b, made::read(north_then_east(), 40.0, 100.0, 1'700'000'000'000'000'000));
  EXPECT_EQ(a.step_count(), b.step_count());
  EXPECT_EQ(a.dead_reckoning().position_m(), b.dead_reckoning().position_m());
}

TEST(Pdr, TheRateOfTheSamplesHardlyMatters) {
  Pdr reference;
  run(reference, made::read(north_then_east(), 65.0, 100.0));
  for (const double rate : {20.0, 50.0, 286.0, 1000.0}) {
    Pdr pdr;
    run(pdr, made::read(north_then_east(), 65.0, rate));
    EXPECT_NEAR(pdr.step_count(), reference.step_count(), 1.0) << rate;
    EXPECT_LT((pdr.dead_reckoning().position_m() - reference.dead_reckoning().position_m()).norm(),
              1.5)
        << rate;
  }
}

TEST(Pdr, OneFifthOfTheSamplesMayBeLost) {
  Readings readings = made::read(north_then_east(), 65.0, 100.0);
  std::mt19937 random(9);
  std::erase_if(readings.imu, [&](const ImuSample&) { return random() % 5 == 0; });
  Pdr pdr(with_linear_steps());
  const Walk walk = run(pdr, readings);
  EXPECT_NEAR(static_cast<double>(walk.steps.size()), 109.0, 2.0);
  EXPECT_NEAR(walk.last.position_m.y(), 56.7 * 0.693, 1.5);
  EXPECT_NEAR(walk.last.position_m.x(), 54.7 * 0.693, 1.5);
}

TEST(Pdr, StandingStillMovesNothing) {
  Readings readings = made::read(Motion{}, 120.0, 100.0);
  made::add_noise(readings, 0.005, 0.05, 0.5, 4);
  Pdr pdr(with_linear_steps());
  const Walk walk = run(pdr, readings);
  EXPECT_TRUE(walk.steps.empty());
  EXPECT_EQ(walk.last.position_m.head<2>().norm(), 0.0);
  EXPECT_EQ(walk.last.speed_mps, 0.0);
}

}  // namespace
}  // namespace vpdr::pdr
