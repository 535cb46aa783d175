#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "core/rotation.hpp"
#include "fusion/core/fusion.hpp"

namespace vpdr::fusion {
namespace {

PoseEstimate odometry(double at_s, double yaw, double east_m = 0.0, double north_m = 0.0) {
  PoseEstimate pose;
  pose.stamp_ns = to_ns(at_s);
  pose.position_m = {99.0 + east_m, 99.0 + north_m, 1.5};  // fusion's walk begins at its own origin
  pose.world_from_body = from_euler({0.1, -0.2, yaw});
  pose.covariance = Matrix6d::Identity() * 0.04;
  return pose;
}

HeadingEstimate heading(double at_s, double yaw, double sigma = 0.1) {
  return {.stamp_ns = to_ns(at_s), .yaw_rad = yaw, .yaw_sigma_rad = sigma};
}

StepEvent step(double at_s, std::uint32_t index, double length = 0.7) {
  StepEvent event;
  event.stamp_ns = to_ns(at_s);
  event.index = index;
  event.length_m = length;
  event.length_sigma_m = 0.05;
  event.yaw_sigma_rad = 0.1;
  return event;
}

HeadingRate rate(double at_s, double value) { return {to_ns(at_s), to_ns(at_s - 0.1), value, 0.2}; }

TEST(Fusion, WaitsForHeadingAndAttitude) {
  Fusion fusion;
  EXPECT_EQ(fusion.mode(), FusionMode::kWaiting);
  EXPECT_FALSE(fusion.latest());
  fusion.process(heading(0.0, 0.0));
  EXPECT_FALSE(fusion.latest());
  fusion.process(odometry(0.0, 0.0));
  ASSERT_TRUE(fusion.latest());
  EXPECT_EQ(fusion.latest()->mode, FusionMode::kInertial);
}

TEST(Fusion, ModesFollowTheSensorStamps) {
  Fusion fusion;
  for (int i = 0; i <= 10; ++i) {
    fusion.process(heading(0.1 * i, 0.0));
    fusion.process(odometry(0.1 * i, 0.0));
  }
  fusion.process(rate(1.0, 0.0));
  EXPECT_EQ(fusion.mode(), FusionMode::kWithVision);
  for (int i = 11; i <= 25; ++i) fusion.process(odometry(0.1 * i, 0.0));
  EXPECT_EQ(fusion.mode(), FusionMode::kInertial);  // vision silent for more than 1 s
  const Matrix6d before = fusion.latest()->pose.covariance;
  fusion.process(rate(4.0, 0.0));
  EXPECT_EQ(fusion.mode(), FusionMode::kCoasting);  // pdr silent for more than 1 s
  ASSERT_TRUE(fusion.latest());
  EXPECT_EQ(fusion.latest()->pose.stamp_ns, to_ns(4.0));
  EXPECT_EQ(fusion.latest()->pose.position_m.x(), 0.0);  // held
  // 1.5 s of walking at 1 m/s unobserved.
  EXPECT_GE(fusion.latest()->pose.covariance(0, 0), before(0, 0) + 2.25);
  EXPECT_GT(fusion.latest()->pose.covariance(5, 5), before(5, 5));
  fusion.process(odometry(4.1, 0.0));
  EXPECT_NE(fusion.mode(), FusionMode::kCoasting);
}

TEST(Fusion, SaysWhenOnlyTheRateOfASilentVisionIsMissing) {
  Fusion fusion;
  fusion.process(heading(0.0, 0.0));
  fusion.process(odometry(0.0, 0.0));
  CorridorHeading corridor;
  corridor.stamp_ns = to_ns(0.05);
  corridor.found = true;
  corridor.heading_rad = 0.1;
  corridor.sigma_rad = 0.01;
  EXPECT_EQ(fusion.process(corridor), Refusal::kNone);
  EXPECT_EQ(fusion.mode(), FusionMode::kInertial);  // the heading itself is not used
  EXPECT_EQ(fusion.diagnostics().corridors_found, 1U);
}

TEST(Fusion, OrientationIsPdrsTurnedByTheCorrection) {
  FusionConfig config;
  config.heading.noise = HeadingNoise::kWhite;
  config.heading.turn_density = 1e-9;
  config.heading.turn_rate_sigma_radps = 1e-6;
  Fusion fusion(config);
  fusion.process(heading(0.0, 1.0, 0.1));
  for (int i = 1; i <= 600; ++i) fusion.process(heading(0.1 * i, i % 2 == 0 ? 1.1 : 0.9, 0.1));
  fusion.process(odometry(60.0, 1.1));
  const FusedPose fused = *fusion.latest();
  EXPECT_NEAR(fused.yaw_rad, 1.0, 0.02);
  const EulerAngles angles = to_euler(fused.pose.world_from_body);
  EXPECT_NEAR(angles.yaw_rad, fused.yaw_rad, 1e-9);  // 1.1 + (fused - 1.1)
  EXPECT_NEAR(angles.roll_rad, 0.1, 1e-9);
  EXPECT_NEAR(angles.pitch_rad, -0.2, 1e-9);
}

TEST(Fusion, CovarianceOfThePoseIsWhole) {
  Fusion fusion;
  for (int i = 0; i <= 20; ++i) {
    fusion.process(heading(0.1 * i, 0.5));
    if (i % 5 == 0) fusion.process(step(0.1 * i, static_cast<std::uint32_t>(i)));
  }
  fusion.process(odometry(2.0, 0.5));
  const PoseEstimate pose = fusion.latest()->pose;
  EXPECT_EQ(pose.position_m.z(), 1.5);
  EXPECT_TRUE(pose.covariance.isApprox(pose.covariance.transpose()));
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(pose.covariance).eigenvalues().minCoeff(), 0.0);
  EXPECT_GE(pose.covariance(0, 0), fusion.state().p(kX, kX));
  EXPECT_EQ(pose.covariance(2, 2), 0.04);  // pdr's
  // Yaw errs as pdr's heading does, 0.1 rad less its white 0.01; wrong by as much, the walk too.
  EXPECT_NEAR(pose.covariance(5, 5), 0.01, 0.0005);
  EXPECT_GT(pose.covariance(1, 5), 0.0);
}

TEST(Fusion, BodyIsNotJustWhereTheStepsPutIt) {
  Fusion fusion;
  fusion.process(heading(0.0, 0.0));
  fusion.process(step(0.5, 1, 0.6));
  const auto beyond_steps = [&fusion](double at_s, double speed_mps) {
    PoseEstimate pose = odometry(at_s, 0.0);
    pose.speed_mps = speed_mps;
    fusion.process(pose);
    const Matrix6d covariance = fusion.latest()->pose.covariance;
    return Eigen::Vector2d(covariance(0, 0) - fusion.state().p(kX, kX),
                           covariance(1, 1) - fusion.state().p(kY, kY));
  };
  // Walking east: uniform over the step under way. Standing: the next walk may have begun.
  EXPECT_TRUE(beyond_steps(0.5, 1.2).isApprox(Eigen::Vector2d(0.03 + 0.0025, 0.0025), 1e-9));
  EXPECT_TRUE(beyond_steps(0.6, 0.0).isApprox(Eigen::Vector2d(0.49 + 0.0025, 0.0025), 1e-9));
}

TEST(Fusion, PositionIsCarriedOnByHalfAStepAtMostAndEndsShortOfTheLastOne) {
  FusionConfig alone;
  alone.step.follow_pdr = false;
  Fusion fusion(alone);
  fusion.process(heading(0.0, 0.0));
  StepEvent last = step(0.5, 1, 0.6);
  last.frequency_hz = 2.0;
  fusion.process(last);
  const auto ahead_at = [&fusion](double at_s) {
    fusion.process(odometry(at_s, 0.0));
    return fusion.latest()->pose.position_m.x() - 0.6;
  };
  EXPECT_NEAR(ahead_at(0.6), 0.12, 1e-12);
  EXPECT_NEAR(ahead_at(0.9), 0.3, 1e-12);
  EXPECT_NEAR(ahead_at(2.0), -0.36, 1e-12);  // stands
}

/// Two steps east of 0.6 m, and what pdr makes of them.
Fusion after_two_steps(const FusionConfig& config, bool with_vision) {
  Fusion fusion(config);
  fusion.process(odometry(0.0, 0.0));
  for (int i = 0; i <= 10; ++i) {
    fusion.process(heading(0.1 * i, 0.0));
    if (with_vision && i > 0) fusion.process(rate(0.1 * i, 0.0));
    if (i == 5 || i == 10) fusion.process(step(0.1 * i, static_cast<std::uint32_t>(i / 5), 0.6));
  }
  fusion.process(odometry(1.0, 0.0, 1.1, 0.04));
  return fusion;
}

TEST(Fusion, WithoutVisionThePositionIsPdrs) {
  const Fusion fusion = after_two_steps({}, false);
  EXPECT_NEAR(fusion.latest()->pose.position_m.x(), 1.1, 1e-12);
  EXPECT_NEAR(fusion.latest()->pose.position_m.y(), 0.04, 1e-12);
  FusionConfig alone;
  alone.step.follow_pdr = false;
  const Fusion by_steps = after_two_steps(alone, false);
  EXPECT_NEAR(by_steps.latest()->pose.position_m.x(), 1.2, 1e-12);
  EXPECT_NEAR(by_steps.latest()->pose.position_m.y(), 0.0, 1e-12);
}

TEST(Fusion, WithVisionAShareOfPdrsBendIsNews) {
  const Fusion fusion = after_two_steps({}, true);
  const Fusion inertial = after_two_steps({}, false);
  ASSERT_EQ(fusion.mode(), FusionMode::kWithVision);
  const auto variance_m2 = [](const Fusion& of) { return bent_variance_m2(of.state())(1, 1); };
  EXPECT_LT(variance_m2(fusion), variance_m2(inertial));
  const double bend_m = 0.04 - inertial.state().x[kY];
  const double share = (fusion.latest()->pose.position_m.y() - fusion.state().x[kY]) / bend_m;
  const double expected = (variance_m2(fusion) + 0.01) / (variance_m2(inertial) + 0.01);
  EXPECT_LT(share, 1.0);
  EXPECT_NEAR(share, expected, 1e-3);
}

TEST(Fusion, BadMeasurementsAreRefusedAndCounted) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Fusion fusion;
  fusion.process(heading(0.0, 0.3));
  fusion.process(odometry(0.0, 0.3));
  EXPECT_EQ(fusion.process(heading(0.1, nan)), Refusal::kNonFinite);
  EXPECT_EQ(fusion.process(heading(0.1, 0.0, 0.0)), Refusal::kOutOfRange);
  EXPECT_EQ(fusion.process(rate(0.1, nan)), Refusal::kNonFinite);
  EXPECT_EQ(fusion.process(step(0.1, 1, -0.5)), Refusal::kOutOfRange);
  EXPECT_EQ(fusion.process(odometry(0.0, 0.1)), Refusal::kDuplicate);
  EXPECT_EQ(fusion.process(odometry(0.1, nan)), Refusal::kNonFinite);
  EXPECT_EQ(fusion.process(heading(0.0, 0.3)), Refusal::kDuplicate);
  EXPECT_NEAR(fusion.latest()->yaw_rad, 0.3, 1e-12);
  const InputCounters headings =
      fusion.diagnostics().inputs[static_cast<std::size_t>(Input::kHeading)];
  EXPECT_EQ(headings.accepted(), 1U);
  EXPECT_EQ(headings.refused(Refusal::kNonFinite), 1U);
  EXPECT_EQ(headings.refused(Refusal::kOutOfRange), 1U);
  EXPECT_EQ(headings.refused(Refusal::kDuplicate), 1U);
}

TEST(Fusion, TooLateIsRefusedAndCounted) {
  Fusion fusion;
  for (int i = 0; i <= 100; ++i) fusion.process(heading(0.1 * i, 0.0));
  EXPECT_EQ(fusion.process(rate(5.05, 0.0)), Refusal::kNone);  // 4.95 s late
  EXPECT_EQ(fusion.process(rate(4.55, 0.0)), Refusal::kBackwardInTime);
  const InputCounters rates = fusion.diagnostics().inputs[static_cast<std::size_t>(Input::kRate)];
  EXPECT_EQ(rates.refused(Refusal::kBackwardInTime), 1U);
}

TEST(Fusion, VisionWhoseClockRunsAheadIsRefused) {
  Fusion fusion;
  fusion.process(heading(1.0, 0.0));
  fusion.process(odometry(1.0, 0.0));
  EXPECT_EQ(fusion.process(rate(3600.0, 0.0)), Refusal::kOutOfRange);
  EXPECT_EQ(fusion.mode(), FusionMode::kInertial);
  EXPECT_EQ(fusion.process(heading(1.1, 0.0)), Refusal::kNone);  // pdr goes on
}

TEST(Fusion, FinalPoseDoesNotDependOnTheOrderOfArrival) {
  // Two minutes of walking; everything may come up to 4 s after its stamp.
  struct Arrival {
    double at_s;
    std::function<void(Fusion&)> give;
  };
  std::vector<Arrival> arrivals;
  const auto add = [&arrivals](const auto& message) {
    arrivals.push_back(
        {to_seconds(message.stamp_ns), [message](Fusion& f) { f.process(message); }});
  };
  for (int i = 0; i <= 2400; ++i) {
    const double t = 0.05 * i;
    const double yaw = std::sin(0.1 * t) * 4.0;
    add(heading(t, wrap_pi(yaw)));
    add(odometry(t, wrap_pi(yaw), 0.01 * i, std::sin(t)));
    if (i % 2 == 0) add(rate(t, 0.4 * std::cos(0.1 * t)));
    if (i % 10 == 0) add(step(t, static_cast<std::uint32_t>(i / 10)));
  }
  const auto run = [&arrivals] {
    Fusion fusion;
    for (const Arrival& arrival : arrivals) arrival.give(fusion);
    return fusion;
  };
  const Fusion in_order = run();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> delay(0.0, 4.0);
  for (Arrival& arrival : arrivals) arrival.at_s += delay(random);
  std::stable_sort(arrivals.begin(), arrivals.end(),
                   [](const Arrival& a, const Arrival& b) { return a.at_s < b.at_s; });
  const Fusion late = run();
  EXPECT_GT(late.diagnostics().reapplied, 1000U);
  EXPECT_EQ(late.latest()->pose.stamp_ns, in_order.latest()->pose.stamp_ns);
  EXPECT_EQ(late.latest()->pose.position_m, in_order.latest()->pose.position_m);
  EXPECT_EQ(late.latest()->pose.covariance, in_order.latest()->pose.covariance);
  EXPECT_EQ(late.latest()->pose.world_from_body.coeffs(),
            in_order.latest()->pose.world_from_body.coeffs());
  EXPECT_EQ(late.latest()->mode, in_order.latest()->mode);
  EXPECT_EQ(late.diagnostics().headings.accepted, in_order.diagnostics().headings.accepted);
}

}  // namespace
}  // namespace vpdr::fusion
