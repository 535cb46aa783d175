#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "pdr/core/step_detector.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Vector3d;

struct Given {
  DetectedStep step;
  TimestampNs at_ns;  ///< stamp of the sample that brought it
};

/// Steps of a board whose specific force has the norm g + signal(t).
std::vector<Given> detect(const std::function<double(double)>& signal, double duration_s,
                          double rate_hz = 100.0, const StepConfig& config = {},
                          TimestampNs start_ns = 0, double turning_radps = 0.0) {
  StepDetector detector(config);
  std::vector<Given> out;
  const Vector3d direction = Vector3d(0.3, -0.5, 0.8).normalized();
  for (int i = 0; i <= static_cast<int>(duration_s * rate_hz); ++i) {
    const double t = i / rate_hz;
    const TimestampNs stamp = start_ns + to_ns(t);
    detector.add(stamp, (kGravityMps2 + signal(t)) * direction, {0.0, 0.0, turning_radps});
    while (const auto step = detector.take()) out.push_back({*step, stamp});
  }
  return out;
}

/// Peaks at 1 s, 1 s + 1 / f, ... until `until_s`; quiet before and after.
std::function<double(double)> walk(double steps_per_s, double until_s, double amplitude = 3.0) {
  return [=](double t) {
    const double phase = (t - 1.0) * steps_per_s;
    if (phase < -0.5 || t > until_s) return 0.0;
    return amplitude * std::cos(2.0 * kPi * phase);
  };
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
  const auto handling = [&](double t) {
    double sum = 0.0;
    for (const double k : knocks) {
      if (std::abs(t - k) < 0.5) sum += 4.0 * std::exp(-0.5 * std::pow((t - k) / 0.1, 2.0));
    }
    return sum;
  };
  EXPECT_LE(detect(handling, 300.0).size(), 8U);
}

TEST(StepDetector, ASpinningBoardDoesNotWalk) {
  EXPECT_TRUE(detect(walk(1.8, 20.0), 24.0, 100.0, {}, 0, 7.0).empty());
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
    while (detector.take()) (t < 13.0 ? before : after) += 1;
  }
  EXPECT_NEAR(before, 16, 1);
  EXPECT_NEAR(after, 48, 3);
}

TEST(StepDetector, SwingIsPeakMinusValley) {
  const auto steps = detect(walk(1.0 / 0.55, 20.0, 2.0), 24.0);
  ASSERT_GT(steps.size(), 10U);
  const ButterworthLowPass filter(4, 3.0, 50.0);
  EXPECT_NEAR(steps[8].step.swing_mps2, 4.0 * filter.gain(1.0 / 0.55), 0.3);
}

}  // namespace
}  // namespace vpdr::pdr
