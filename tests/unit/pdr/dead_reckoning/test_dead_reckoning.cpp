#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <optional>
#include <vector>

#include "core/rotation.hpp"
#include "pdr/core/dead_reckoning/dead_reckoning.hpp"

namespace vpdr::pdr {
namespace {

DeadReckonedStep plain(double length_m, double yaw_deg) {
  DeadReckonedStep step;
  step.length_m = length_m;
  step.relative_yaw_rad = to_radians(yaw_deg);
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

Eigen::Matrix2d position_covariance(const DeadReckoning& track) {
  return track.covariance().topLeftCorner<2, 2>();
}

/// Every step alike, heading good to `forward_sigma_rad`, nothing from time.
DeadReckoningConfig only_forward(double forward_sigma_rad) {
  DeadReckoningConfig config;
  config.forward_sigma_rad = forward_sigma_rad;
  return config;
}

TEST(DeadReckoning, CommonErrorsNeverAverageOut) {
  DeadReckoning track(only_forward(0.1));
  DeadReckonedStep step = plain(0.7, 0.0);
  step.scale_sigma = 0.05;
  for (int i = 0; i < 100; ++i) track.add(step);
  // 70 m straight: 5 % along, 0.1 rad across.
  EXPECT_NEAR(std::sqrt(position_covariance(track)(0, 0)), 3.5, 1e-6);
  EXPECT_NEAR(std::sqrt(position_covariance(track)(1, 1)), 7.0, 1e-6);
  EXPECT_NEAR(std::sqrt(track.walking_variance_rad2()), 0.1, 1e-9);
}

TEST(DeadReckoning, APocketLetsTheForwardAxisPointAside) {
  DeadReckoningConfig config;
  config.forward_sigma_rad = 0.05;
  config.pocket_sigma_rad = 0.6;
  const DeadReckoning waist(worn_at(config, Carry::kWaist));
  const DeadReckoning pocket(worn_at(config, Carry::kPocket));
  EXPECT_NEAR(std::sqrt(waist.walking_variance_rad2()), 0.05, 1e-9);
  EXPECT_NEAR(std::sqrt(pocket.walking_variance_rad2()), 0.6, 1e-9);
}

TEST(DeadReckoning, ErrorsOfOneStepAverageOut) {
  DeadReckoning track(only_forward(0.0));
  DeadReckonedStep step = plain(0.7, 90.0);
  step.length_noise_m = 0.07;
  step.heading_noise_rad = 0.05;
  for (int i = 0; i < 100; ++i) track.add(step);
  EXPECT_NEAR(std::sqrt(position_covariance(track)(1, 1)), 0.07 * 10.0, 1e-9);
  EXPECT_NEAR(std::sqrt(position_covariance(track)(0, 0)), 0.7 * 0.05 * 10.0, 1e-9);
}

TEST(DeadReckoning, OutAndBackCancelsTheCommonErrors) {
  DeadReckoning track(only_forward(0.1));
  for (int i = 0; i < 100; ++i) {
    DeadReckonedStep step = plain(0.7, i < 50 ? 0.0 : 180.0);
    step.scale_sigma = 0.05;
    track.add(step);
  }
  EXPECT_LT(track.position_m().norm(), 1e-9);
  EXPECT_LT(std::sqrt(position_covariance(track).trace()), 1e-6);
}

TEST(DeadReckoning, ABiasBendsTheWalkAndARestStraightensIt) {
  // 60 s at 0.01 rad/s that nobody knows of: the relative yaw turns away from a straight walk east.
  DeadReckoningConfig config = only_forward(0.0);
  config.bias_sigma_radps = 0.01;
  config.rest_sigma_radps = 1e-6;
  DeadReckoning track(config);
  RelativeMotion motion;
  motion.elapsed_s = 0.5;
  motion.up_s = {0.0, 0.0, 0.5};
  for (int i = 0; i < 120; ++i) {
    track.pass(motion);
    track.add(plain(0.7, to_degrees(-0.01 * 0.5 * (i + 1))));
  }
  EXPECT_LT(track.position_m().y(), -20.0);
  EXPECT_NEAR(std::sqrt(track.covariance()(2, 2)), 0.6, 0.02);
  motion.rest_bias_radps = Eigen::Vector3d(0.0, 0.0, -0.01);
  motion.bias_change_radps = {0.0, 0.0, -0.01};  // it is taken from the rate from now on
  track.pass(motion);
  EXPECT_NEAR(track.offset_rad(), 0.605, 0.005);
  EXPECT_NEAR(track.revision_rad(), 0.605, 0.005);
  EXPECT_NEAR(track.position_m().y(), 0.0, 2.0);  // of 24 m: straightened to first order
  EXPECT_LT(std::sqrt(track.covariance()(2, 2)), 0.03);
  const double before = track.offset_rad();
  motion.rest_bias_radps.reset();
  motion.bias_change_radps.setZero();
  for (int i = 0; i < 20; ++i) track.pass(motion);
  EXPECT_NEAR(track.offset_rad(), before, 1e-4);
}

TEST(DeadReckoning, ABiasGoesWithTheBoardHoweverItIsTurned) {
  // -0.01 rad/s about the board's x axis, known by a rest: nothing while that axis is level, all of
  // it while it points up, the other way round while it points down.
  DeadReckoningConfig config;
  config.rest_sigma_radps = 1e-6;
  DeadReckoning track(config);
  const auto pass = [&](const Eigen::Vector3d& up, std::optional<Eigen::Vector3d> rest) {
    RelativeMotion motion;
    motion.elapsed_s = 10.0;
    motion.up_s = 10.0 * up;
    motion.rest_bias_radps = rest;
    track.pass(motion);
    return track.offset_rad();
  };
  EXPECT_NEAR(pass({0.0, 0.0, 1.0}, Eigen::Vector3d(-0.01, 0.0, 0.0)), 0.0, 1e-9);
  EXPECT_NEAR(pass({0.0, 0.0, 1.0}, {}), 0.0, 1e-6);
  EXPECT_NEAR(pass({1.0, 0.0, 0.0}, {}), 0.1, 1e-5);
  EXPECT_NEAR(pass({-1.0, 0.0, 0.0}, {}), 0.0, 1e-5);
}

TEST(DeadReckoning, WhoWalkedWhenTheSamplesFailedMayBeAnywhereNear) {
  DeadReckoning track;
  track.add(plain(0.7, 0.0));
  const Eigen::Matrix3d before = track.covariance();
  track.stray(4.0);
  const Eigen::Matrix3d after = track.covariance();
  EXPECT_NEAR(after(0, 0) - before(0, 0), 8.0, 1e-9);  // 4 m, in two directions
  EXPECT_NEAR(after(1, 1) - before(1, 1), 8.0, 1e-9);
  EXPECT_EQ(after(2, 2), before(2, 2));
}

TEST(DeadReckoning, BlindTurnsAreBoundedByTheCircle) {
  DeadReckoning track;
  RelativeMotion motion;
  motion.elapsed_s = 1.0;
  motion.blind_rad2 = 9.0;
  for (int i = 0; i < 5; ++i) track.pass(motion);
  EXPECT_NEAR(track.covariance()(2, 2), kPi * kPi / 3.0, 1e-6);
}

TEST(PositionError, IsTheEuclideanDistance) {
  EXPECT_DOUBLE_EQ(position_error_m({4.0, 6.0}, {1.0, 2.0}), 5.0);
}

TEST(DeadReckoning, AFoundOffsetTurnsTheTrackAboutItsStart) {
  DeadReckoningConfig config;
  config.forward_sigma_rad = 0.5;
  DeadReckoning reckoning(config);
  DeadReckonedStep step;
  step.length_m = 1.0;
  for (int i = 0; i < 10; ++i) reckoning.add(step);
  // 10 m east with 5 m of doubt across; the walk led north, it is found, to 0.1 rad.
  EXPECT_NEAR(reckoning.covariance()(1, 1), 25.0, 1e-9);
  reckoning.find_forward(0.5 * kPi, 0.01);
  EXPECT_NEAR(reckoning.position_m().x(), 0.0, 1e-9);
  EXPECT_NEAR(reckoning.position_m().y(), 10.0, 1e-9);
  EXPECT_NEAR(reckoning.covariance()(0, 0), 1.0, 1e-9);
  EXPECT_NEAR(reckoning.covariance()(1, 1), 0.0, 1e-9);
  EXPECT_NEAR(reckoning.revision_rad(), 0.5 * kPi, 1e-12);
  // From now on the steps lead north by themselves.
  reckoning.add(step);
  EXPECT_NEAR(reckoning.position_m().y(), 11.0, 1e-9);
  EXPECT_NEAR(reckoning.covariance()(0, 0), 1.21, 1e-9);
  // Carried anew, what was walked stays as it is, and another offset is another matter.
  reckoning.carried_anew(1.0);
  reckoning.find_forward(1.0, 0.01);
  EXPECT_NEAR(reckoning.position_m().x(), 0.0, 1e-9);
  EXPECT_NEAR(reckoning.position_m().y(), 11.0, 1e-9);
  EXPECT_NEAR(reckoning.covariance()(0, 0), 1.21, 1e-9);
}

TEST(DeadReckoning, CarriedOnTheDirectionIsLessSureFromThereOn) {
  DeadReckoningConfig config;
  config.forward_sigma_rad = 0.1;
  config.rate_noise_rad_sqrt_s = 1e-6;
  DeadReckoning reckoning(config);
  const DeadReckonedStep step{.length_m = 1.0};
  for (int i = 0; i < 10; ++i) reckoning.add(step);
  EXPECT_NEAR(reckoning.covariance()(1, 1), 100.0 * 0.01, 1e-9);
  reckoning.carried_on(0.16);
  EXPECT_NEAR(reckoning.covariance()(1, 1), 100.0 * 0.01, 1e-9);
  for (int i = 0; i < 10; ++i) reckoning.add(step);
  // Twenty metres with the old error, ten with the new one.
  EXPECT_NEAR(reckoning.covariance()(1, 1), 400.0 * 0.01 + 100.0 * 0.16, 1e-9);
}

TEST(DeadReckoning, AForwardAxisThatIsFoundTurnsAllThatItsErrorHasToDoWith) {
  DeadReckoningConfig config;
  config.forward_sigma_rad = 0.1;
  DeadReckoning reckoning(config);
  const DeadReckonedStep step{.length_m = 1.0};
  const StraightStretch along{.direction_rad = 0.0, .variance_rad2 = 0.0004, .is_usual = true};
  for (int i = 0; i < 10; ++i) reckoning.add(step);
  reckoning.take(along);
  // A corridor tells then how much of the gyroscope's error and of the axis' there is together.
  reckoning.carried_on(0.06);
  for (int i = 0; i < 30; ++i) reckoning.add(step);
  RelativeMotion motion;
  motion.elapsed_s = 1.0;
  motion.blind_rad2 = 0.04;
  reckoning.pass(motion);
  reckoning.take(along);
  const double before = reckoning.covariance()(1, 2);
  EXPECT_LT(before, -0.5);
  // What lay north of the way lies west of it.
  reckoning.find_forward(0.5 * kPi, 0.0242);
  const Eigen::Matrix3d after = reckoning.covariance();
  EXPECT_GT(after(0, 2), 0.5);
  EXPECT_NEAR(after(1, 2), 0.0, 0.1);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(after).eigenvalues()[0], -1e-9);
}

}  // namespace
}  // namespace vpdr::pdr
