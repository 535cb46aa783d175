#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <vector>

#include "tests/unit/pdr/steps/step_signals.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Vector3d;
using made::bumps;
using made::Given;
using made::Handling;
using made::Signal;
using made::walk;

/// The confirmed steps of the default detector.
std::vector<Given> detect(const Signal& signal, double duration_s, double rate_hz = 100.0,
                          const StepConfig& config = {}, TimestampNs start_ns = 0,
                          const Handling& handling = {}) {
  StepDetector detector(config);
  return made::confirmed(made::words(detector, signal, duration_s, rate_hz, start_ns, handling));
}

TEST(StepDetector, CountsEveryStepAtItsPeak) {
  const auto steps = detect(walk(1.8, 20.72), 24.0);  // peaks from 1 s to 20.44 s
  ASSERT_NEAR(static_cast<double>(steps.size()), 36.0, 1.0);
  for (const Given& g : steps) {
    const double phase = (to_seconds(g.step.stamp_ns) - 1.0) * 1.8;
    EXPECT_NEAR(phase, std::round(phase), 0.06) << to_seconds(g.step.stamp_ns);
  }
  for (std::size_t i = 6; i < steps.size(); ++i) {
    EXPECT_NEAR(steps[i].step.frequency_hz, 1.8, 0.05);
    EXPECT_NEAR(to_seconds(steps[i].step.stamp_ns - steps[i].step.previous_ns), 1.0 / 1.8, 0.02);
  }
}

TEST(StepDetector, GivesEachStepSoonOnceTheWalkIsKnown) {
  const auto steps = detect(walk(1.8, 20.0), 24.0);
  ASSERT_GT(steps.size(), 10U);
  for (std::size_t i = 5; i < steps.size(); ++i) {
    EXPECT_LT(to_seconds(steps[i].at_ns - steps[i].step.stamp_ns), 0.3);
  }
  // The held-back first ones come within the time of the confirming peaks.
  EXPECT_LT(to_seconds(steps[0].at_ns - steps[0].step.stamp_ns), 2.5);
}

TEST(StepDetector, AKnockCostsAFewSteps) {
  // One sample of 150 m/s^2 at 50 Hz every 10 s: it neither hides the steps after it nor ends them.
  const Signal steady = walk(1.8, 60.0);
  const Signal knocked = [&](double t) {
    const double since = std::fmod(t, 10.0);
    return since > 4.999 && since < 5.019 ? 150.0 : steady(t);
  };
  const auto expected = detect(steady, 64.0, 50.0).size();
  EXPECT_GT(detect(knocked, 64.0, 50.0).size(), expected - 12);
}

TEST(StepDetector, TheSamplingRateDoesNotMatter) {
  const auto reference = detect(walk(1.8, 20.0), 24.0, 100.0);
  for (const double rate : {20.0, 50.0, 286.0, 1000.0}) {
    const auto steps = detect(walk(1.8, 20.0), 24.0, rate);
    ASSERT_EQ(steps.size(), reference.size()) << rate;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_NEAR(to_seconds(steps[i].step.stamp_ns - reference[i].step.stamp_ns), 0.0, 0.015);
    }
  }
}

TEST(StepDetector, TheClockOfTheSamplesDoesNotMatter) {
  const TimestampNs start = 1'574'659'531'695'000'000;
  const auto now = detect(walk(1.8, 20.0), 24.0);
  const auto then = detect(walk(1.8, 20.0), 24.0, 100.0, {}, start);
  ASSERT_EQ(now.size(), then.size());
  for (std::size_t i = 0; i < now.size(); ++i) {
    EXPECT_EQ(now[i].step.stamp_ns + start, then[i].step.stamp_ns);
  }
}

TEST(StepDetector, ThePapersMinimumIntervalCannotGiveItsOwnTable) {
  // 0.75 s allows 1.33 steps/s at most; the paper reports 1.53 (path A) and 1.71 (path B).
  StepConfig as_printed;
  as_printed.min_interval_s = 0.75;
  for (const double frequency : {1.53, 1.71}) {
    const double duration = 34.0;
    const double truth = frequency * duration;
    const auto printed = detect(walk(frequency, 1.0 + duration), 38.0, 100.0, as_printed);
    const auto ours = detect(walk(frequency, 1.0 + duration), 38.0);
    EXPECT_LT(static_cast<double>(printed.size()), 0.6 * truth) << frequency;
    EXPECT_NEAR(static_cast<double>(ours.size()), truth, 1.5) << frequency;
  }
}

TEST(StepDetector, CountsALimp) {
  // Left and right differ in interval (0.42, 0.63 s) and in height.
  const auto limp = [](double t) {
    if (t < 1.0 || t > 20.0) return 0.0;
    const double u = std::fmod(t - 1.0, 1.05);
    const auto bump = [](double x) { return std::exp(-0.5 * x * x / (0.08 * 0.08)); };
    return 5.0 * (bump(u - 0.2) + 0.7 * bump(u - 0.62)) - 1.5;
  };
  EXPECT_NEAR(static_cast<double>(detect(limp, 24.0).size()), 36.0, 2.0);
}

TEST(StepDetector, StandingGivesNoSteps) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0.0, 0.3);
  EXPECT_TRUE(detect([&](double) { return normal(random); }, 600.0).empty());
}

TEST(StepDetector, HandlingGivesNoSteps) {
  // Single knocks and swings at odd times.
  std::mt19937 random(5);
  std::vector<double> knocks;
  std::uniform_real_distribution<double> pause(0.4, 3.0);
  for (double t = 1.0; t < 300.0; t += pause(random)) knocks.push_back(t);
  EXPECT_LE(detect(bumps(knocks), 300.0).size(), 8U);
}

TEST(StepDetector, ASpinningBoardDoesNotWalk) {
  Handling spinning;
  spinning.rate_radps = 7.0;
  EXPECT_TRUE(detect(walk(1.8, 20.0), 24.0, 100.0, {}, 0, spinning).empty());
}

TEST(StepDetector, TurningMuchAndBouncingLittleIsHandling) {
  // 0.8 + 0.45 x 1.1 m/s^2 (twice 0.6 less the filter's 5 %) = 1.3 rad/s.
  Handling handling;
  handling.rate_radps = 2.0;
  EXPECT_TRUE(detect(walk(1.8, 20.0, 0.6), 24.0, 100.0, {}, 0, handling).empty());
  handling.rate_radps = 1.0;
  EXPECT_GT(detect(walk(1.8, 20.0, 0.6), 24.0, 100.0, {}, 0, handling).size(), 30U);
  // An arm that swings as fast bounces: 0.8 + 0.45 x 5.7 = 3.4 rad/s.
  handling.rate_radps = 2.0;
  EXPECT_GT(detect(walk(1.8, 20.0, 3.0), 24.0, 100.0, {}, 0, handling).size(), 30U);
}

TEST(StepDetector, ABoardThatTiltsFromStrideToStrideDoesNotWalk) {
  const auto tilting = [](double rate_radps) {
    Handling handling;
    handling.turned = [rate_radps](double t) {
      return Eigen::Quaterniond(Eigen::AngleAxisd(rate_radps * t, Vector3d::UnitX()));
    };
    return handling;
  };
  // 1.11 s to a stride: 0.55 rad against 0.4, 0.22 rad against 0.4.
  EXPECT_TRUE(detect(walk(1.8, 20.0), 24.0, 100.0, {}, 0, tilting(0.55)).empty());
  EXPECT_GT(detect(walk(1.8, 20.0), 24.0, 100.0, {}, 0, tilting(0.2)).size(), 30U);
}

TEST(StepDetector, ALegThatSwingsTheBoardWalks) {
  // 0.6 rad to and fro with each stride: as before from stride to stride.
  Handling swinging;
  swinging.turned = [](double t) {
    return Eigen::Quaterniond(
        Eigen::AngleAxisd(0.6 * std::sin(2.0 * kPi * 0.9 * t), Vector3d::UnitX()));
  };
  EXPECT_GT(detect(walk(1.8, 20.0), 24.0, 100.0, {}, 0, swinging).size(), 30U);
}

TEST(StepDetector, OnTheTrunkEveryBounceOfARowIsAStep) {
  // A shuffle about a table: uneven, so nobody's walk, but three and more in a row.
  const Signal shuffle = bumps({2.0, 2.5, 3.7, 4.3, 5.5, 6.4, 6.9, 8.2});
  StepDetector anywhere{{}, Carry::kUnknown};
  EXPECT_TRUE(made::confirmed(made::words(anywhere, shuffle, 14.0)).empty());
  StepDetector waist{{}, Carry::kWaist};
  EXPECT_EQ(made::confirmed(made::words(waist, shuffle, 14.0)).size(), 8U);
  StepDetector sitting_down{{}, Carry::kWaist};
  EXPECT_TRUE(made::confirmed(made::words(sitting_down, bumps({2.0, 2.8}), 14.0)).empty());
}

TEST(StepDetector, AnnouncesAtOnceThenConfirmsOrWithdraws) {
  // A walk, then four knocks that are none.
  const auto knocks = bumps({30.0, 30.5, 31.8, 32.2});
  const auto both = [&, w = walk(1.8, 20.0)](double t) { return w(t) + knocks(t); };
  StepDetector detector;
  std::map<TimestampNs, std::vector<StepStatus>> said;
  for (const Given& given : made::words(detector, both, 40.0)) {
    auto& words = said[given.step.stamp_ns];
    const double latency_s = to_seconds(given.at_ns - given.step.stamp_ns);
    EXPECT_LT(latency_s, words.empty() ? 0.3 : 5.0);  // under one step, then the last word
    if (given.step.status == StepStatus::kTentative) {
      EXPECT_GT(given.step.probability, 0.0);
      EXPECT_LT(given.step.probability, 1.0);
    }
    words.push_back(given.step.status);
  }
  using enum StepStatus;
  std::size_t held_back = 0;
  std::size_t withdrawn = 0;
  for (const auto& [stamp, words] : said) {
    const bool final_at_once = words == std::vector{kConfirmed};
    held_back += words == std::vector{kTentative, kConfirmed} ? 1 : 0;
    withdrawn += words == std::vector{kTentative, kWithdrawn} ? 1 : 0;
    EXPECT_TRUE(final_at_once || words.size() == 2);
    EXPECT_EQ(to_seconds(stamp) > 29.0, words.back() == kWithdrawn) << to_seconds(stamp);
  }
  EXPECT_EQ(held_back, 3U);
  EXPECT_EQ(withdrawn, 4U);
}

TEST(StepDetector, ASilenceWithdrawsWhatIsTentative) {
  StepDetector detector;
  auto said = made::words(detector, bumps({1.0, 1.5}), 2.0);
  ASSERT_EQ(said.size(), 2U);
  detector.add(to_ns(5.0), {0.0, 0.0, kGravityMps2}, Vector3d::Zero());
  for (const Given& given : said) {
    const auto word = detector.take();
    ASSERT_TRUE(word);
    EXPECT_EQ(word->stamp_ns, given.step.stamp_ns);
    EXPECT_EQ(word->status, StepStatus::kWithdrawn);
  }
  EXPECT_FALSE(detector.take());
}

TEST(StepDetector, AGapEndsTheWalkAndANewOneIsConfirmedAgain) {
  StepDetector detector;
  int before = 0;
  int after = 0;
  bool restarted = false;
  const auto signal = walk(1.8, 60.0);
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.01 * i;
    if (t > 10.0 && t < 13.0) continue;
    const bool first_after = t >= 13.0 && before > 0 && after == 0 && !restarted;
    if (first_after) {
      EXPECT_TRUE(detector.walking());
    }
    detector.add(to_ns(t), {0.0, 0.0, kGravityMps2 + signal(t)}, Vector3d::Zero());
    if (first_after) {
      EXPECT_FALSE(detector.walking());
      restarted = true;
    }
    while (const auto step = detector.take()) {
      if (step->status == StepStatus::kConfirmed) (t < 13.0 ? before : after) += 1;
    }
  }
  EXPECT_NEAR(before, 16, 1);
  EXPECT_NEAR(after, 48, 3);
}

TEST(StepDetector, SwingIsPeakMinusValley) {
  const auto steps = detect(walk(1.0 / 0.55, 20.0, 2.0), 24.0);
  ASSERT_GT(steps.size(), 10U);
  EXPECT_NEAR(steps[8].step.swing_mps2, 4.0, 0.3);
  // What the low-pass takes of a runner's is taken back.
  const auto running = detect(walk(2.8, 20.0, 6.0), 24.0);
  ASSERT_GT(running.size(), 20U);
  EXPECT_NEAR(running[15].step.swing_mps2, 12.0, 0.6);
}

}  // namespace
}  // namespace vpdr::pdr
