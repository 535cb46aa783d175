#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "pdr/core/attitude/attitude_error_filter.hpp"
#include "pdr/core/attitude/saturation_detector.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// A level body that faces east, still for `dt` seconds, seen with a tilt that is wrong by `tilt`.
AttitudeErrorFilter::Motion still(double dt, const Vector3d& tilt = Vector3d::Zero()) {
  AttitudeErrorFilter::Motion motion;
  motion.duration_s = dt;
  motion.rotation = dt * Matrix3d::Identity();
  // The truth is exp(tilt) times the estimate: the estimate's world sees gravity's reaction askew.
  motion.velocity_mps = dt * (exp_rotation(-tilt) * Vector3d(0.0, 0.0, kGravityMps2));
  return motion;
}

TEST(AttitudeErrorFilter, AFirstVelocityByHand) {
  // Tilt sigma 0.3, nothing else uncertain, dt = 0.1: the velocity that tilt brings has sigma
  // 0.3 * 9.80665 * 0.1 = 0.2942, covariance with tilt 0.3 * 0.2942 = 0.08826. An estimate tilted
  // by 0.1 about y reads -g sin 0.1 dt = -0.0979 m/s along x. Measured velocity 0 with variance 1 *
  // 2 * 1 / 0.1 = 20 (usual speed 1 m/s, alike for 1 s): gain 0.08826 / (0.08655 + 20) = 4.394e-3,
  // turn 4.394e-3 * 0.0979 = 4.302e-4 about +y.
  AttitudeErrorConfig config;
  config.initial_tilt_sigma_rad = 0.3;
  config.initial_bias_sigma_radps = 1e-12;
  config.initial_scale_sigma = 1e-12;
  config.rate_noise_rad_sqrt_s = 1e-12;
  config.force_noise_mps2_sqrt_s = 1e-12;
  config.usual_speed_mps = 1.0;
  config.speed_memory_s = 1e12;  // the speed stays the usual one
  AttitudeErrorFilter filter(config);
  filter.restart(0.0);
  filter.predict(still(0.1, Vector3d(0.0, 0.1, 0.0)));
  filter.correct_velocity(0.1, false);
  const Vector3d turn = filter.take_turn();
  const double moved = 0.1 * kGravityMps2;
  const double covariance = 0.09 * moved;
  const double variance = 1.0 + 0.09 * moved * moved;  // of the velocity, 1 m/s at the start
  EXPECT_NEAR(turn.y(), covariance / (variance + 20.0) * moved * std::sin(0.1), 1e-9);
  EXPECT_NEAR(turn.x(), 0.0, 1e-12);
  EXPECT_NEAR(turn.z(), 0.0, 1e-12);
}

TEST(AttitudeErrorFilter, LevelsATiltedHorizon) {
  AttitudeErrorFilter filter{AttitudeErrorConfig{}};
  Vector3d tilt(0.1, -0.05, 0.0);
  for (int i = 0; i < 500; ++i) {
    filter.predict(still(0.04, tilt));
    filter.correct_velocity(0.04, false);
    tilt -= filter.take_turn();
  }
  EXPECT_LT(tilt.head<2>().norm(), to_radians(0.2));
  EXPECT_NEAR(tilt.z(), 0.0, 1e-9) << "gravity tells nothing of heading";
}

TEST(AttitudeErrorFilter, AVelocityThatIsKnownIsNoTilt) {
  // A level body is pushed to 1 m/s within a second and goes on.
  const auto tilted_by = [](bool known) {
    AttitudeErrorFilter filter{AttitudeErrorConfig{}};
    filter.restart(0.0);
    double largest = 0.0;
    for (int i = 0; i < 500; ++i) {
      AttitudeErrorFilter::Motion motion = still(0.04);
      const double speed = std::clamp(0.04 * (i - 100), 0.0, 1.0);
      if (i > 100 && i <= 125) motion.velocity_mps.x() += 0.04;
      filter.predict(motion);
      filter.correct_velocity(0.04, false, known ? Vector2d(speed, 0.0) : Vector2d(0.0, 0.0));
      const Vector3d turn = filter.take_turn();
      EXPECT_NEAR(turn.x(), 0.0, 1e-12);
      largest = std::max(largest, std::abs(turn.y()));
    }
    return largest;
  };
  EXPECT_LT(tilted_by(true), 1e-9);
  EXPECT_GT(tilted_by(false), 1e-4);
}

TEST(AttitudeErrorFilter, AtRestNothingIsExpectedToMove) {
  AttitudeErrorFilter filter{AttitudeErrorConfig{}};
  filter.restart(0.0);
  for (int i = 0; i < 100; ++i) {
    filter.predict(still(0.04));
    filter.correct_velocity(0.04, true, Vector2d(1.0, 0.0));
    EXPECT_NEAR(filter.take_turn().norm(), 0.0, 1e-12);
  }
}

/// Heading variance of a board that lay for a minute, the field off by `innovation_rad`, and is
/// then moved for 7 s without a field.
double heading_variance_after_rest(double innovation_rad) {
  AttitudeErrorFilter filter{AttitudeErrorConfig{}};
  filter.align_heading(0.0, 1e-3);
  for (int i = 0; i < 1675; ++i) {
    const bool at_rest = i < 1500;
    filter.predict(still(0.04));
    filter.correct_velocity(0.04, at_rest);
    if (at_rest) filter.correct_heading(innovation_rad, 0.1, Vector2d::Zero());
    filter.take_turn();
  }
  return filter.covariance_rad2(Vector3d::Zero())(2, 2);
}

TEST(AttitudeErrorFilter, WhatCorrectsABoardAtRestTellsNothingOfItsErrorsInMotion) {
  EXPECT_NEAR(heading_variance_after_rest(0.05), heading_variance_after_rest(0.0), 1e-12);
}

TEST(AttitudeErrorFilter, FindsTheBiasThatTiltsTheHorizon) {
  AttitudeErrorFilter filter{AttitudeErrorConfig{}};
  const Vector3d bias(0.01, -0.006, 0.008);
  Vector3d tilt = Vector3d::Zero();
  for (int i = 0; i < 3000; ++i) {
    tilt -= 0.04 * (bias - filter.bias_radps());  // a body that does not turn is seen turning
    filter.predict(still(0.04, tilt));
    filter.correct_velocity(0.04, false);
    tilt -= filter.take_turn();
  }
  EXPECT_LT((filter.bias_radps() - bias).head<2>().norm(), 5e-4);
  EXPECT_NEAR(filter.bias_radps().z(), 0.0, 1e-9) << "the vertical axis cannot be seen";
  EXPECT_NEAR(std::sqrt(filter.bias_covariance()(2, 2)), 0.01, 1e-3);
}

TEST(AttitudeErrorFilter, FindsTheScaleOfAnAxisThatTurnsTheHorizon) {
  // Half turns forth and back about the body's x axis, which stays level, read 1 % too small.
  AttitudeErrorFilter filter{AttitudeErrorConfig{}};
  const double scale = 1.01;
  const double dt = 0.04;
  double tilt = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const double rate = (i / 50) % 2 == 0 ? 1.5 : -1.5;  // as read
    AttitudeErrorFilter::Motion motion = still(dt, Vector3d(tilt, 0.0, 0.0));
    motion.turn.col(0) = Vector3d(rate * dt, 0.0, 0.0);
    motion.turned_rad = std::abs(rate) * dt;
    tilt += rate * dt * (scale - filter.scale().x());
    filter.predict(motion);
    filter.correct_velocity(dt, false);
    tilt -= filter.take_turn().x();
  }
  EXPECT_NEAR(filter.scale().x(), scale, 2e-3);
  EXPECT_NEAR(filter.scale().y(), 1.0, 1e-9);
}

TEST(AttitudeErrorFilter, HeadingCorrectionByHand) {
  // Heading variance 0.01 after alignment, measurement variance 0.01, 0.02 rad off: half of it.
  AttitudeErrorConfig config;
  config.initial_tilt_sigma_rad = 1e-9;
  config.heading_base_sigma_rad = 0.0;
  AttitudeErrorFilter filter(config);
  filter.align_heading(0.0, 0.01);
  filter.correct_heading(0.02, 0.01, Vector2d::Zero());
  EXPECT_NEAR(filter.take_turn().z(), 0.01, 1e-12);
  EXPECT_NEAR(filter.covariance_rad2(Vector3d::Zero())(2, 2), 0.005, 1e-12);
}

TEST(AttitudeErrorFilter, AHeadingCountsTheTurnThatIsPending) {
  // The same field twice, once with the first correction applied in between, once with it pending:
  // an innovation is of the estimate as it stands, so that both come to the same turn.
  const auto aligned = [] {
    AttitudeErrorFilter filter{AttitudeErrorConfig{}};
    filter.align_heading(0.0, 0.04);
    return filter;
  };
  AttitudeErrorFilter applied = aligned();
  applied.correct_heading(0.1, 0.04, Vector2d::Zero());
  const double first = applied.take_turn().z();
  applied.correct_heading(0.1 - first, 0.04, Vector2d::Zero());
  AttitudeErrorFilter pending = aligned();
  pending.correct_heading(0.1, 0.04, Vector2d::Zero());
  pending.correct_heading(0.1, 0.04, Vector2d::Zero());
  EXPECT_GT(first, 0.01);
  EXPECT_NEAR(pending.take_turn().z(), first + applied.take_turn().z(), 1e-12);
}

TEST(AttitudeErrorFilter, ASurprisingFieldCountsLess) {
  // As above, 1 rad off: usual is 5 (0.01 + 0.1^2) = 0.1, doubt 1 / 0.1 = 10: gain
  // 0.01 / (0.01 + 0.1) = 1 / 11.
  AttitudeErrorConfig config;
  config.initial_tilt_sigma_rad = 1e-9;
  AttitudeErrorFilter filter(config);
  filter.align_heading(0.0, 0.01);
  filter.correct_heading(1.0, 0.01, Vector2d::Zero());
  EXPECT_NEAR(filter.take_turn().z(), 1.0 / 11.0, 1e-9);
}

TEST(AttitudeErrorFilter, TheFieldTouchesNeitherTiltNorItsCertainty) {
  AttitudeErrorFilter filter{AttitudeErrorConfig{}};
  for (int i = 0; i < 50; ++i) {
    filter.predict(still(0.04, Vector3d(0.02, 0.01, 0.0)));
    filter.correct_velocity(0.04, false);
  }
  filter.take_turn();
  const Matrix3d before = filter.covariance_rad2(Vector3d::Zero());
  filter.correct_heading(0.5, 0.001, Vector2d(1.0, 2.0));
  const Vector3d turn = filter.take_turn();
  const Matrix3d after = filter.covariance_rad2(Vector3d::Zero());
  EXPECT_EQ(turn.x(), 0.0);
  EXPECT_EQ(turn.y(), 0.0);
  EXPECT_GT(turn.z(), 0.01);
  EXPECT_LT((before - after).topLeftCorner(2, 2).norm(), 1e-15);
  EXPECT_LT(after(2, 2), before(2, 2));
}

TEST(AttitudeErrorFilter, TimingAddsAlongTheAxisOfTheTurn) {
  AttitudeErrorConfig config;
  config.timing_sigma_s = 0.01;
  const AttitudeErrorFilter filter(config);
  const Matrix3d still_covariance = filter.covariance_rad2(Vector3d::Zero());
  const Matrix3d turning = filter.covariance_rad2(Vector3d(0.0, 3.0, 0.0));
  EXPECT_NEAR((turning - still_covariance)(1, 1), 9e-4, 1e-12);  // (3 * 0.01)^2
  EXPECT_NEAR((turning - still_covariance)(0, 0), 0.0, 1e-15);
}

TEST(AttitudeErrorFilter, LevelledTiltStaysWithinWhatIsConfigured) {
  AttitudeErrorConfig config;
  config.least_tilt_sigma_rad = 0.01;
  config.initial_tilt_sigma_rad = 0.2;
  config.base.sigma_rad = 0.0;
  AttitudeErrorFilter filter{config};
  const auto tilt_sigma = [&] { return std::sqrt(filter.covariance_rad2(Vector3d::Zero())(0, 0)); };
  filter.level(0.05);
  EXPECT_NEAR(tilt_sigma(), 0.05, 1e-12);
  filter.level(0.0);
  EXPECT_NEAR(tilt_sigma(), 0.01, 1e-12);
  filter.level(1.0);
  EXPECT_NEAR(tilt_sigma(), 0.2, 1e-12);
}

TEST(AttitudeErrorFilter, AlignmentTurnsTheWorldWithIt) {
  // A quarter turn counter-clockwise: a velocity along x becomes one along y.
  AttitudeErrorConfig config;
  config.initial_tilt_sigma_rad = 0.1;
  AttitudeErrorFilter a{config};
  AttitudeErrorFilter b{config};
  const Vector3d tilt(0.05, 0.0, 0.0);
  a.predict(still(0.04, tilt));
  b.predict(still(0.04, tilt));
  b.align_heading(0.5 * kPi, 0.01);
  a.correct_velocity(0.04, false);
  b.correct_velocity(0.04, false);
  const Vector3d turn_a = a.take_turn();
  const Vector3d turn_b = b.take_turn();
  EXPECT_GT(turn_a.x(), 1e-6);
  EXPECT_NEAR(turn_b.y(), turn_a.x(), 1e-12);
  EXPECT_NEAR(turn_b.x(), -turn_a.y(), 1e-12);
}

TEST(SaturationDetector, KnowsALimitByItsRepetition) {
  SaturationDetector detector(14.0);
  EXPECT_FALSE(detector.add(Vector3d(19.6, 1.0, 2.0)));
  EXPECT_FALSE(detector.add(Vector3d(19.6, 1.1, 2.0)));
  EXPECT_TRUE(detector.add(Vector3d(19.6, 1.2, 2.0)));
  EXPECT_TRUE(detector.add(Vector3d(19.6, 1.2, 2.0)));
  EXPECT_FALSE(detector.add(Vector3d(19.5, 1.2, 2.0)));
}

TEST(SaturationDetector, SmallEqualReadingsAreNoLimit) {
  SaturationDetector detector(14.0);
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(detector.add(Vector3d(0.0, 0.0, 9.81)));
}

}  // namespace
}  // namespace vpdr::pdr
