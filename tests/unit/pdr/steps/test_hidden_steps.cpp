// Steps that a swinging limb hides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/unit/pdr/steps/step_signals.hpp"

namespace vpdr::pdr {
namespace {

using made::Given;
using made::Signal;

constexpr double kStrideS = 1.06;

std::vector<Given> detect(const Signal& signal, double duration_s, double rate_radps) {
  StepDetector detector(StepConfig{});
  const made::Handling handling{.rate_radps = rate_radps};
  return made::confirmed(made::words(detector, signal, duration_s, 100.0, 0, handling));
}

/// A peak a stride from 1 s on; of the step between them there is nothing.
Signal one_of_two(double until_s) { return made::walk(1.0 / kStrideS, until_s); }

TEST(HiddenSteps, StridesOfASwingingArmAreTwoStepsEach) {
  const auto steps = detect(one_of_two(1.0 + 17.5 * kStrideS), 24.0, 1.8);  // 18 peaks
  ASSERT_NEAR(static_cast<double>(steps.size()), 35.0, 2.0);
  for (const Given& given : steps) {
    const double halves = (to_seconds(given.step.stamp_ns) - 1.0) / (0.5 * kStrideS);
    EXPECT_NEAR(halves, std::round(halves), 0.1) << to_seconds(given.step.stamp_ns);
  }
  for (std::size_t i = 4; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].step.previous_ns, steps[i - 1].step.stamp_ns);
    EXPECT_NEAR(steps[i].step.frequency_hz, 2.0 / kStrideS, 0.1);
  }
}

TEST(HiddenSteps, WhoBouncesWithoutSwingingALimbDoesNotWalk) {
  EXPECT_TRUE(detect(one_of_two(20.0), 24.0, 0.5).empty());
}

TEST(HiddenSteps, UnevenPeaksAreNoStrides) {
  const Signal uneven = made::bumps({1.0, 1.95, 3.2, 4.1, 5.5, 6.5, 7.9, 8.9, 10.2});
  EXPECT_TRUE(detect(uneven, 14.0, 1.8).empty());
}

/// Strong and weak steps in turn; the weak ones `hidden` hardly show.
Signal limp(const std::vector<int>& hidden) {
  return [hidden](double t) {
    double sum = 0.0;
    for (int n = 0; n < 30; ++n) {
      const double since = t - 1.0 - 0.5 * kStrideS * n;
      if (std::abs(since) > 0.5) continue;
      const bool hides = std::find(hidden.begin(), hidden.end(), n) != hidden.end();
      const double height = n % 2 == 0 ? 5.0 : (hides ? 0.8 : 2.5);
      sum += height * std::exp(-0.5 * std::pow(since / 0.1, 2.0));
    }
    return sum;
  };
}

TEST(HiddenSteps, OneThatHidesWithinAWalkIsFilledIn) {
  const auto all = detect(limp({}), 20.0, 1.0);
  ASSERT_GE(all.size(), 29U);
  const auto filled = detect(limp({11, 19}), 20.0, 1.0);
  ASSERT_EQ(filled.size(), all.size());
  for (const std::size_t n : {11U, 19U}) {
    EXPECT_NEAR(to_seconds(filled[n].step.stamp_ns), to_seconds(all[n].step.stamp_ns), 0.05);
  }
}

}  // namespace
}  // namespace vpdr::pdr
