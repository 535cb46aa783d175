// A board that falls silent while its owner walks: a radio that drops out, a cable that is loose.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "tests/unit/pdr/steps/step_signals.hpp"

namespace vpdr::pdr {
namespace {

using IsSilent = std::function<bool(double)>;

/// Silent for the last `lasts_s` of each `every_s`.
IsSilent every(double every_s, double lasts_s) {
  return [=](double t) { return std::fmod(t, every_s) > every_s - lasts_s; };
}

/// Confirmed steps of a board, 100 Hz, that is heard only where it is not silent.
std::vector<DetectedStep> steps(const made::Signal& signal, const IsSilent& silent,
                                double duration_s, const StepConfig& config = {}) {
  StepDetector detector(config);
  std::vector<DetectedStep> out;
  for (int i = 0; i <= static_cast<int>(100.0 * duration_s); ++i) {
    const double t = 0.01 * i;
    if (silent(t)) continue;
    detector.add(to_ns(t), {0.0, 0.0, kGravityMps2 + signal(t)}, Eigen::Vector3d::Zero());
    while (const auto step = detector.take()) {
      if (step->status == StepStatus::kConfirmed) out.push_back(*step);
    }
  }
  return out;
}

TEST(StepSilences, AWalkGoesOnInThem) {
  const made::Signal walk = made::walk(1.8, 41.0);
  const std::size_t whole = steps(walk, every(100.0, 0.0), 45.0).size();
  EXPECT_NEAR(static_cast<double>(whole), 72.0, 1.0);
  for (const double lasts_s : {0.2, 0.3, 0.6, 1.0, 2.0}) {
    const std::vector<DetectedStep> heard = steps(walk, every(5.0, lasts_s), 45.0);
    EXPECT_NEAR(static_cast<double>(heard.size()), static_cast<double>(whole), 1.0) << lasts_s;
    // Each where it would have been: the walk is as even as before.
    for (std::size_t i = 4; i < heard.size(); ++i) {
      EXPECT_NEAR(to_seconds(heard[i].stamp_ns - heard[i - 1].stamp_ns), 1.0 / 1.8, 0.12)
          << lasts_s << " s, step " << i;
    }
  }
}

TEST(StepSilences, WhoeverStopsInOneIsTakenOnForNoLongerThanIt) {
  // Stops right after 20.4 s; the board is silent from 20.5 to 22.5 s.
  const std::vector<DetectedStep> heard = steps(
      made::walk(1.8, 20.4), [](double t) { return t > 20.5 && t < 22.5; }, 30.0);
  EXPECT_LE(heard.back().stamp_ns, to_ns(22.6));
  const auto walked =
      static_cast<double>(steps(made::walk(1.8, 20.4), every(100.0, 0.0), 30.0).size());
  EXPECT_LE(static_cast<double>(heard.size()), walked + 4.0);
}

TEST(StepSilences, WhoeverStopsIsNotTakenOnByManyInARow) {
  // A link that brings a few samples at a time, and a board of 6 Hz: what is repeated is soon
  // nothing but repetitions.
  const made::Signal walk = made::walk(1.8, 20.4);
  for (const auto& [every_s, lasts_s] : std::vector<std::pair<double, double>>{
           {0.17, 0.16}, {0.3, 0.2}, {0.3, 0.25}, {0.5, 0.4}, {1.2, 1.0}, {2.5, 2.1}}) {
    const std::vector<DetectedStep> heard = steps(walk, every(every_s, lasts_s), 60.0);
    if (heard.empty()) continue;
    EXPECT_LE(heard.back().stamp_ns, to_ns(26.4)) << lasts_s << " s of each " << every_s << " s";
  }
}

TEST(StepSilences, ALongerOneEndsTheWalk) {
  StepConfig config;
  config.gap_s = 1.0;
  const std::vector<DetectedStep> heard = steps(
      made::walk(1.8, 40.0), [](double t) { return t > 20.0 && t < 21.5; }, 45.0, config);
  for (const DetectedStep& step : heard) {
    EXPECT_FALSE(step.stamp_ns > to_ns(20.1) && step.stamp_ns < to_ns(21.4));
  }
}

TEST(StepSilences, WhoDoesNotWalkTakesNoStepInThem) {
  EXPECT_TRUE(steps([](double) { return 0.0; }, every(3.0, 1.0), 30.0).empty());
  // Knocks before and after a silence are no walk.
  EXPECT_TRUE(steps(made::bumps({4.0, 4.6, 6.2, 12.9, 15.3}), every(5.0, 0.4), 30.0).empty());
}

}  // namespace
}  // namespace vpdr::pdr
