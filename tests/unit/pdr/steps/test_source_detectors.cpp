// The step detectors of the source documents, on signals whose steps can be counted by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pdr/core/carry.hpp"
#include "tests/unit/pdr/steps/step_signals.hpp"

namespace vpdr::pdr {
namespace {

using made::bumps;
using made::Given;
using made::Signal;
using made::walk;

std::vector<Given> detect(DetectorKind kind, const Signal& signal, double duration_s,
                          StepConfig config = {}) {
  config.detector = kind;
  StepDetector detector(config);
  return made::words(detector, signal, duration_s);
}

/// Square wave about g.
Signal square(double period_s, double amplitude) {
  return [=](double t) { return std::fmod(t, period_s) < 0.5 * period_s ? amplitude : -amplitude; };
}

TEST(PeakStepDetector, CountsEveryPeakOverTheThreshold) {
  // S3.1: bumps at odd times are steps to it, for it knows no walk.
  const std::vector<double> instants = {2.0, 2.6, 4.5, 7.0, 7.5};
  const auto steps = detect(DetectorKind::kPeaks, bumps(instants), 10.0);
  ASSERT_EQ(steps.size(), instants.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_NEAR(to_seconds(steps[i].step.stamp_ns), instants[i], 0.06);
    EXPECT_EQ(steps[i].step.status, StepStatus::kConfirmed);
  }
  EXPECT_NEAR(steps[1].step.frequency_hz, 1.0 / 0.6, 0.1);
}

TEST(PeakStepDetector, PeaksWithinTheMinimumIntervalCountOnce) {
  StepConfig config;
  config.min_interval_s = 0.75;  // as printed
  // A peak each 0.5 s from 1 s to 9 s: every second one is let through.
  EXPECT_EQ(detect(DetectorKind::kPeaks, walk(2.0, 9.1), 12.0, config).size(), 9U);
  EXPECT_EQ(detect(DetectorKind::kPeaks, walk(2.0, 9.1), 12.0).size(), 17U);
}

TEST(PeakStepDetector, LowPeaksAreNone) {
  EXPECT_TRUE(detect(DetectorKind::kPeaks, walk(2.0, 9.1, 0.4), 12.0).empty());
}

TEST(SwingStepDetector, CountsSwingsOverTheThreshold) {
  StepConfig config;
  config.swing_threshold_mps2 = 3.0;
  // S1.12: a_max - a_min = 4 m/s^2 in a period of 0.5 s: 19 maxima after a rise within 9.9 s (the
  // first half wave has no rise before it).
  const auto steps = detect(DetectorKind::kSwing, square(0.5, 2.0), 9.9, config);
  EXPECT_EQ(steps.size(), 19U);
  for (const Given& given : steps) EXPECT_NEAR(given.step.swing_mps2, 4.0, 1e-6);
  EXPECT_TRUE(detect(DetectorKind::kSwing, square(0.5, 1.45), 9.9, config).empty());
}

TEST(SwingStepDetector, RipplesOnTheWayAreNoSteps) {
  // 2 Hz of +-3 m/s^2 with a ripple of +-0.5 m/s^2 at 10 Hz.
  const auto rippled = [](double t) {
    return 3.0 * std::cos(4.0 * kPi * t) + 0.5 * std::cos(20.0 * kPi * t);
  };
  EXPECT_NEAR(static_cast<double>(detect(DetectorKind::kSwing, rippled, 10.2).size()), 20.0, 1.0);
}

TEST(SpectrumStepDetector, FindsTheFrequencyAndItsCrests) {
  // S1.1: crests at 1 s, 1.5 s, ...; whole windows of 2.56 s fit until 30 s.
  const auto steps = detect(DetectorKind::kSpectrum, walk(2.0, 40.0), 30.0);
  ASSERT_GT(steps.size(), 50U);
  EXPECT_LE(steps.size(), 58U);
  for (std::size_t i = 3; i < steps.size(); ++i) {
    EXPECT_NEAR(steps[i].step.frequency_hz, 2.0, 0.051);
    const double phase = 2.0 * (to_seconds(steps[i].step.stamp_ns) - 1.0);
    EXPECT_NEAR(phase, std::round(phase), 0.06);
    EXPECT_NEAR(to_seconds(steps[i].step.stamp_ns - steps[i - 1].step.stamp_ns), 0.5, 0.03);
  }
}

TEST(SpectrumStepDetector, CountsAtAnyPace) {
  for (const double pace : {1.2, 1.53, 1.71, 1.8, 2.3, 2.9}) {
    const auto steps = detect(DetectorKind::kSpectrum, walk(pace, 100.0), 60.0);
    // The first 1.3 s lie before the middle of the first window, the last 1.3 s after that of the
    // last one.
    EXPECT_NEAR(static_cast<double>(steps.size()), pace * (59.0 - 1.5), 2.0) << pace;
  }
}

TEST(SpectrumStepDetector, EachStepOfAWalkFollowsTheOneBefore) {
  // One that did not would set off from a stand, and be shorter.
  const auto steps = detect(DetectorKind::kSpectrum, walk(1.8, 40.0), 30.0);
  ASSERT_GT(steps.size(), 40U);
  for (std::size_t i = 1; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].step.previous_ns, steps[i - 1].step.stamp_ns);
  }
}

TEST(SpectrumStepDetector, WeakWavesAreNone) {
  EXPECT_TRUE(detect(DetectorKind::kSpectrum, walk(2.0, 40.0, 0.5), 30.0).empty());
}

TEST(StepDetector, EveryDetectorStartsAnewAfterASilence) {
  for (const auto kind :
       {DetectorKind::kGait, DetectorKind::kPeaks, DetectorKind::kSwing, DetectorKind::kSpectrum}) {
    StepConfig config;
    config.detector = kind;
    StepDetector detector(config);
    made::words(detector, walk(1.8, 20.0), 10.0);
    EXPECT_TRUE(detector.walking());
    detector.add(to_ns(20.0), {0.0, 0.0, kGravityMps2}, Eigen::Vector3d::Zero());
    EXPECT_FALSE(detector.walking());
  }
}

TEST(Carry, IsReadFromWords) {
  EXPECT_EQ(carry_named("waist (lower back)"), Carry::kWaist);
  EXPECT_EQ(carry_named("FrontPocket"), Carry::kPocket);
  EXPECT_EQ(carry_named("hand, flat in front of the chest"), Carry::kHand);
  EXPECT_EQ(carry_named("InHand"), Carry::kHand);
  EXPECT_EQ(carry_named("glasses"), Carry::kHead);
  EXPECT_EQ(carry_named("bag"), Carry::kUnknown);
  EXPECT_EQ(carry_named(""), Carry::kUnknown);
  EXPECT_TRUE(on_trunk(Carry::kChest));
  EXPECT_FALSE(on_trunk(Carry::kHand));
  EXPECT_FALSE(on_trunk(Carry::kUnknown));
}

}  // namespace
}  // namespace vpdr::pdr
