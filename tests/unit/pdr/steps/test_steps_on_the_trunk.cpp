#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "pdr/core/steps/step_detector.hpp"
#include "tests/unit/pdr/steps/made_trunk.hpp"

namespace vpdr::pdr {
namespace {

using made::Footfall;
using made::ordinary_walk;
using made::TrunkOfAWalker;

/// All words about the steps of a walker who wears the board askew; `more` goes upward.
std::vector<DetectedStep> words(
    const TrunkOfAWalker& walker, Carry carry,
    const std::function<double(double)>& more_mps2 = [](double) { return 0.0; }) {
  const Eigen::Vector3d up = made::askew() * Eigen::Vector3d::UnitZ();
  StepDetector detector{{}, carry};
  std::vector<DetectedStep> out;
  for (int i = 0; i < static_cast<int>(100.0 * walker.end_s()); ++i) {
    const double t = 0.01 * i;
    detector.add(to_ns(t), made::askew() * walker.force_mps2(t) + more_mps2(t) * up,
                 Eigen::Vector3d::Zero());
    while (const auto step = detector.take()) out.push_back(*step);
  }
  return out;
}

std::vector<double> confirmed_s(const std::vector<DetectedStep>& all, double from_s = 0.0) {
  std::vector<double> out;
  for (const DetectedStep& step : all) {
    const double t = to_seconds(step.stamp_ns);
    if (step.status == StepStatus::kConfirmed && t > from_s) out.push_back(t);
  }
  return out;
}

std::vector<Footfall> then(std::vector<Footfall> falls, const std::vector<Footfall>& more) {
  falls.insert(falls.end(), more.begin(), more.end());
  return falls;
}

TEST(StepsOnTheTrunk, StepsThatDoNotBounceAreFoundByTheWeight) {
  // Sixteen ordinary steps to 9.25 s, four slow ones in a turn, then six ordinary ones.
  const std::vector<double> slow_s{10.0, 10.7, 11.3, 12.1};
  auto falls = ordinary_walk(16);
  for (const double t : slow_s) falls.push_back({t, 0.15});
  const TrunkOfAWalker walker(then(falls, ordinary_walk(6, 12.8)));
  const auto steps = confirmed_s(words(walker, Carry::kWaist));
  EXPECT_EQ(steps.size(), 26U);
  for (const double t : slow_s) {
    EXPECT_TRUE(std::any_of(steps.begin(), steps.end(), [t](double step) {
      return std::abs(step - t) < 0.1;
    })) << t;
  }
  // In the hand nobody knows what goes across.
  EXPECT_LE(confirmed_s(words(walker, Carry::kHand)).size(), 22U);
}

TEST(StepsOnTheTrunk, AWeakBounceBetweenTwoStepsIsNone) {
  // Slow steps; half-way between them the arms put something down.
  auto falls = ordinary_walk(16);
  for (int i = 0; i < 10; ++i) falls.push_back({10.2 + i});
  const auto arms_mps2 = [](double t) {
    const double since = std::fmod(t - 0.2, 1.0) - 0.5;
    return t < 10.0 || std::abs(since) > 0.3 ? 0.0 : 1.4 * std::cos(2.0 * kPi * 2.5 * since);
  };
  const auto all = words(TrunkOfAWalker(falls), Carry::kWaist, arms_mps2);
  EXPECT_EQ(confirmed_s(all).size(), 26U);
}

TEST(StepsOnTheTrunk, SwayingFromLegToLegIsNoWalk) {
  // A minute of the weight going over without any bounce, 5 s after a walk.
  auto falls = ordinary_walk(16);
  for (int i = 0; i < 60; ++i) falls.push_back({14.5 + i, 0.0});
  const auto steps = confirmed_s(words(TrunkOfAWalker(falls), Carry::kWaist));
  EXPECT_NEAR(static_cast<double>(steps.size()), 16.0, 1.0);
}

TEST(StepsOnTheTrunk, BetweenTwoBouncesOfAWalkIsNoStep) {
  // A swinging arm with the board that is said to be worn: what alternates does so half a step
  // late.
  const TrunkOfAWalker late(ordinary_walk(30, 1.35, 0.7));
  StepDetector detector{{}, Carry::kWaist};
  std::vector<DetectedStep> all;
  const TrunkOfAWalker walker(ordinary_walk(30, 1.0, 0.7));
  for (int i = 0; i < static_cast<int>(100.0 * walker.end_s()); ++i) {
    Eigen::Vector3d force = walker.force_mps2(0.01 * i);
    force.y() = late.force_mps2(0.01 * i).y();
    detector.add(to_ns(0.01 * i), force, Eigen::Vector3d::Zero());
    while (const auto step = detector.take()) all.push_back(*step);
  }
  EXPECT_NEAR(static_cast<double>(confirmed_s(all).size()), 30.0, 2.0);
}

TEST(StepsOnTheTrunk, EveryStepHasOneLastWordAndTheConfirmedOnesRise) {
  auto falls = ordinary_walk(16);
  for (int i = 0; i < 12; ++i) falls.push_back({9.8 + 0.4 * i + 0.05 * (i % 5), 0.4 * (i % 4)});
  falls = then(falls, ordinary_walk(8, 15.5));
  std::map<TimestampNs, std::vector<StepStatus>> said;
  TimestampNs latest = 0;
  for (const DetectedStep& word : words(TrunkOfAWalker(falls), Carry::kChest)) {
    said[word.stamp_ns].push_back(word.status);
    if (word.status != StepStatus::kConfirmed) continue;
    EXPECT_GT(word.stamp_ns, latest);
    latest = word.stamp_ns;
  }
  for (const auto& [stamp, all] : said) {
    ASSERT_FALSE(all.empty());
    EXPECT_LE(all.size(), 2U) << to_seconds(stamp);
    if (all.size() == 2U) {
      EXPECT_EQ(all.front(), StepStatus::kTentative);
      EXPECT_NE(all.back(), StepStatus::kTentative);
    }
  }
}

/// All words about the bounces and sways of a board that somebody fiddles with, never the same
/// twice.
std::vector<DetectedStep> words_of_fiddling(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise;
  StepDetector detector{{}, Carry::kWaist};
  std::vector<DetectedStep> out;
  double phase = 0.0;
  double lateral_mps2 = 0.0;
  double vertical_mps2 = 0.0;
  for (int i = 0; i < 12'000; ++i) {
    const double t = 0.01 * i;
    phase += 0.11 + 0.05 * noise(random);
    lateral_mps2 += 0.05 * (6.0 * noise(random) - lateral_mps2);
    vertical_mps2 += 0.1 * (4.0 * noise(random) - vertical_mps2);
    const double bounce_mps2 = 1.5 * (1.0 + std::sin(0.3 * t)) * std::cos(phase) + vertical_mps2;
    detector.add(to_ns(t), {0.0, std::sin(0.5 * phase) + lateral_mps2, kGravityMps2 + bounce_mps2},
                 {4.0 * std::abs(std::sin(0.07 * t)), 0.0, 0.0});
    while (const auto step = detector.take()) out.push_back(*step);
  }
  return out;
}

TEST(StepsOnTheTrunk, EveryStepIsAnnouncedBeforeItIsWithdrawnAndTakesItsTime) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    std::set<TimestampNs> open;
    for (const DetectedStep& step : words_of_fiddling(seed)) {
      if (step.status != StepStatus::kWithdrawn) {
        EXPECT_GT(step.frequency_hz, 0.0) << seed;
      }
      if (step.status == StepStatus::kTentative) {
        EXPECT_TRUE(open.insert(step.stamp_ns).second) << seed;
        // Who listens remembers as many.
        EXPECT_LE(open.size(), 8U) << seed;
      } else {
        const bool was_open = open.erase(step.stamp_ns) > 0;
        EXPECT_TRUE(was_open || step.status == StepStatus::kConfirmed) << seed;
      }
    }
  }
}

}  // namespace
}  // namespace vpdr::pdr
