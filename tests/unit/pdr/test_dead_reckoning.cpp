#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/rotation.hpp"
#include "pdr/core/dead_reckoning.hpp"

namespace vpdr::pdr {
namespace {

DeadReckonedStep plain(double length_m, double yaw_deg) {
  DeadReckonedStep step;
  step.length_m = length_m;
  step.yaw_rad = to_radians(yaw_deg);
  step.elapsed_s = 0.5;
  return step;
}

TEST(DeadReckoning, AddsStepsByCosineAndSine) {
  DeadReckoning track;
  track.add(plain(0.5, 60.0));   // + (0.25, 0.4330127)
  track.add(plain(0.8, 180.0));  // + (-0.8, 0)
  track.add(plain(0.6, -90.0));  // + (0, -0.6)
  EXPECT_NEAR(track.position_m().x(), -0.55, 1e-12);
  EXPECT_NEAR(track.position_m().y(), -0.1669873, 1e-7);
  EXPECT_NEAR(track.path_length_m(), 1.9, 1e-12);
  EXPECT_NEAR(track.distance_m(), 0.574791, 1e-6);
}

TEST(DeadReckoning, CompassViewIsThePaperRecurrence) {
  // The paper's own sums: phi clockwise from north, theta_k = phi_k - phi_1, X += L sin, Y += L
  // cos.
  const std::vector<double> azimuths = {250.0, 250.0, 340.0, 20.0, 110.0, 163.0};
  DeadReckoning track;
  double x = 0.0;
  double y = 0.0;
  double theta = 0.0;
  for (const double azimuth : azimuths) {
    track.add(plain(0.7, to_degrees(yaw_from_azimuth(to_radians(azimuth)))));
    theta = wrap_two_pi(to_radians(azimuth - azimuths.front()));
    x += 0.7 * std::sin(theta);
    y += 0.7 * std::cos(theta);
    EXPECT_NEAR(wrap_pi(track.compass_turn_rad() - theta), 0.0, 1e-9);
  }
  EXPECT_NEAR(track.compass_position_m().x(), x, 1e-12);
  EXPECT_NEAR(track.compass_position_m().y(), y, 1e-12);
}

TEST(DeadReckoning, FirstStepOfTheCompassViewGoesAlongY) {
  DeadReckoning track;
  track.add(plain(0.7, 33.0));
  EXPECT_NEAR(track.compass_position_m().x(), 0.0, 1e-12);
  EXPECT_NEAR(track.compass_position_m().y(), 0.7, 1e-12);
  EXPECT_NEAR(track.compass_turn_rad(), 0.0, 1e-12);
  track.add(plain(0.7, -57.0));  // a right turn: clockwise, to +X
  EXPECT_NEAR(to_degrees(track.compass_turn_rad()), 90.0, 1e-9);
  EXPECT_NEAR(track.compass_position_m().x(), 0.7, 1e-12);
}

TEST(DeadReckoning, CommonErrorsNeverAverageOut) {
  DeadReckoningConfig config;
  config.heading_correlation_s = 1e5;
  DeadReckoning track(config);
  DeadReckonedStep step = plain(0.7, 0.0);
  step.scale_sigma = 0.05;
  step.heading_sigma_rad = 0.1;
  for (int i = 0; i < 100; ++i) track.add(step);
  // 70 m straight: 5 % along, 0.1 rad across.
  EXPECT_NEAR(std::sqrt(track.covariance_m2()(0, 0)), 3.5, 1e-6);
  EXPECT_NEAR(std::sqrt(track.covariance_m2()(1, 1)), 7.0, 0.01);
  EXPECT_NEAR(track.heading_leverage_m().x(), 0.0, 1e-9);
  EXPECT_NEAR(track.heading_leverage_m().y(), 7.0, 0.01);
}

TEST(DeadReckoning, ErrorsOfOneStepAverageOut) {
  DeadReckoning track;
  DeadReckonedStep step = plain(0.7, 90.0);
  step.length_noise_m = 0.07;
  step.heading_noise_rad = 0.05;
  for (int i = 0; i < 100; ++i) track.add(step);
  EXPECT_NEAR(std::sqrt(track.covariance_m2()(1, 1)), 0.07 * 10.0, 1e-9);
  EXPECT_NEAR(std::sqrt(track.covariance_m2()(0, 0)), 0.7 * 0.05 * 10.0, 1e-9);
}

TEST(DeadReckoning, OutAndBackCancelsTheScaleError) {
  DeadReckoningConfig config;
  config.heading_correlation_s = 1e5;
  DeadReckoning track(config);
  for (int i = 0; i < 100; ++i) {
    DeadReckonedStep step = plain(0.7, i < 50 ? 0.0 : 180.0);
    step.scale_sigma = 0.05;
    step.heading_sigma_rad = 0.1;
    track.add(step);
  }
  EXPECT_LT(track.position_m().norm(), 1e-9);
  EXPECT_LT(std::sqrt(track.covariance_m2().trace()), 0.1);
}

TEST(DeadReckoning, TurningTheTrackTurnsPositionAndCovariance) {
  DeadReckoning track;
  DeadReckonedStep step = plain(1.0, 0.0);
  step.length_noise_m = 0.2;
  step.heading_sigma_rad = 0.1;
  track.add(step);
  track.turn(0.5 * kPi);
  EXPECT_NEAR(track.position_m().x(), 0.0, 1e-12);
  EXPECT_NEAR(track.position_m().y(), 1.0, 1e-12);
  EXPECT_NEAR(track.covariance_m2()(1, 1), 0.04, 1e-12);
  EXPECT_NEAR(track.covariance_m2()(0, 0), 0.01, 1e-12);
}

TEST(PositionError, IsTheEuclideanDistance) {
  EXPECT_DOUBLE_EQ(position_error_m({4.0, 6.0}, {1.0, 2.0}), 5.0);
}

}  // namespace
}  // namespace vpdr::pdr
