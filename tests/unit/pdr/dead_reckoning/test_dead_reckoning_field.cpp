// What the magnetometer tells dead reckoning: north, the iron of the device, and nothing where a
// magnet is near.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <random>

#include "core/rotation.hpp"
#include "pdr/core/dead_reckoning/dead_reckoning.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Rotation2Dd;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// A walker whose gyroscope's zero yaw points `zero_rad` from east; 0.7 m steps, a field each.
struct Walker {
  double zero_rad = 0.0;
  Vector3d iron_ut = Vector3d::Zero();
  Vector2d truth_m = Vector2d::Zero();

  /// One step at a true yaw through the earth's 30 uT and a disturbance (world axes).
  void step(DeadReckoning& track, double yaw_rad, const Vector2d& disturbance_ut,
            double length_m = 0.7, double told_length_m = 0.7) {
    const double relative = yaw_rad - zero_rad;
    RelativeMotion motion;
    motion.elapsed_s = 0.5;
    motion.up_s = {0.0, 0.0, 0.5};
    track.pass(motion);
    MeanField field;
    field.level_rows.leftCols<2>() = Rotation2Dd(relative).toRotationMatrix();
    field.horizontal_ut = Rotation2Dd(-zero_rad) * (Vector2d(0.0, 30.0) + disturbance_ut) +
                          field.level_rows * iron_ut;
    track.take(field);
    DeadReckonedStep taken;
    taken.length_m = told_length_m;
    taken.relative_yaw_rad = relative;
    taken.scale_sigma = 0.1;
    track.add(taken);
    truth_m += length_m * Vector2d(std::cos(yaw_rad), std::sin(yaw_rad));
  }
};

TEST(DeadReckoningField, TheFirstFieldTurnsTheTrackAboutItsStart) {
  DeadReckoning track;
  DeadReckonedStep step;
  step.length_m = 2.0;
  track.add(step);
  EXPECT_FALSE(track.yaw_is_absolute());
  EXPECT_NEAR(track.position_m().x(), 2.0, 1e-12);
  MeanField field;  // north is seen along odom's x: odom's x points north
  field.horizontal_ut = Vector2d(30.0, 0.0);
  track.take(field);
  EXPECT_TRUE(track.yaw_is_absolute());
  EXPECT_NEAR(to_degrees(track.offset_rad()), 90.0, 1e-6);
  EXPECT_NEAR(track.position_m().x(), 0.0, 1e-6);
  EXPECT_NEAR(track.position_m().y(), 2.0, 1e-6);
  EXPECT_EQ(track.revision_rad(), 0.0);
  // What turns the zero of yaw swings the 2 m to the west and the east.
  const Eigen::Matrix3d p = track.covariance();
  EXPECT_NEAR(p(0, 2), -2.0 * p(2, 2), 0.02 * p(2, 2));
}

TEST(DeadReckoningField, DeclinationTurnsMagneticNorthToTrueNorth) {
  DeadReckoning track({}, {}, to_radians(5.0));
  MeanField field;
  field.horizontal_ut = Vector2d(0.0, 30.0);
  track.take(field);
  EXPECT_NEAR(to_degrees(track.offset_rad()), -5.0, 1e-9);
}

TEST(DeadReckoningField, LaterFieldsStraightenWhatWasWalkedBefore) {
  Walker walker{.zero_rad = 0.8};
  DeadReckoningConfig config;
  config.bias_sigma_radps = 1e-6;
  DeadReckoning track(config);
  for (int i = 0; i < 15; ++i) walker.step(track, 0.0, {10.0, 0.0});  // 18 degrees off
  EXPECT_GT((track.position_m() - walker.truth_m).norm(), 2.0);
  for (int i = 0; i < 120; ++i) walker.step(track, 0.0, {0.0, 0.0});
  const double error = track.offset_rad() - 0.8;
  EXPECT_NEAR(error, 0.0, to_radians(4.0));
  // The whole walk is turned by what is left, not only its later part.
  EXPECT_NEAR(track.position_m().y(), 0.7 * 135 * std::sin(error), 0.7);
  EXPECT_GT(std::abs(track.revision_rad()), to_radians(8.0));
}

TEST(DeadReckoningField, AStartBesideSteelIsDoubtedWhereTheFieldIsKnown) {
  const auto walk = [](bool known, int beside, int away) {
    Walker walker{.zero_rad = 0.8};
    DeadReckoning track;
    if (known) track.expect({.horizontal_ut = 30.0, .up_ut = 0.0});
    for (int i = 0; i < beside; ++i) walker.step(track, 0.0, {35.0, 20.0});  // 35 degrees off
    for (int i = 0; i < away; ++i) walker.step(track, 0.0, {0.0, 0.0});
    return std::pair(std::abs(wrap_pi(track.offset_rad() - 0.8)),
                     std::sqrt(track.covariance()(2, 2)));
  };
  const auto [error, sigma] = walk(true, 3, 0);
  EXPECT_GT(2.0 * sigma, error);
  const auto [unknown_error, unknown_sigma] = walk(false, 3, 0);
  EXPECT_GT(unknown_error, 2.0 * unknown_sigma);
  // Away from it, north is found the sooner.
  EXPECT_LT(walk(true, 3, 25).first, 0.6 * walk(false, 3, 25).first);
}

TEST(DeadReckoningField, TurningTellsIronFromTheField) {
  Walker walker{.zero_rad = -0.4, .iron_ut = Vector3d(3.0, -4.0, 0.0)};
  DeadReckoning track;
  for (int i = 0; i < 160; ++i) walker.step(track, 0.5 * kPi * (i / 20), {0.0, 0.0});
  EXPECT_NEAR(track.iron_ut().x(), 3.0, 0.6);
  EXPECT_NEAR(track.iron_ut().y(), -4.0, 0.6);
  EXPECT_NEAR(track.offset_rad(), -0.4, to_radians(1.0));
}

TEST(DeadReckoningField, TheIronOfAnUncalibratedDeviceIsFound) {
  for (const Vector3d& iron :
       {Vector3d(20.0, 0.0, 0.0), Vector3d(30.0, -26.0, 0.0), Vector3d(-45.0, 40.0, 0.0)}) {
    Walker walker{.zero_rad = -0.4, .iron_ut = iron};
    DeadReckoning track;
    for (int i = 0; i < 80; ++i) walker.step(track, 0.05 * i, {0.0, 0.0});
    EXPECT_LT((track.iron_ut() - iron).norm(), 0.15 * iron.norm()) << iron.transpose();
    EXPECT_NEAR(wrap_pi(track.offset_rad() + 0.4), 0.0, to_radians(10.0)) << iron.transpose();
    // The walk before it was known is turned as well.
    EXPECT_LT((track.position_m() - walker.truth_m).norm(), 5.0) << iron.transpose();
  }
}

TEST(DeadReckoningField, ASuspicionOfIronIsThePriorThatItWouldHaveBeen) {
  // What is suspected late is as if it had been known from the start, where nothing is odd.
  FieldConfig wide;
  wide.iron_sigma_ut = 20.0;
  Walker walker{.zero_rad = -0.4, .iron_ut = Vector3d(2.0, 1.0, 0.0)};
  Walker same = walker;
  DeadReckoning late;
  DeadReckoning early({}, wide);
  for (int i = 0; i < 40; ++i) {
    walker.step(late, 0.5 * kPi * (i / 20), {0.0, 0.0});
    same.step(early, 0.5 * kPi * (i / 20), {0.0, 0.0});
  }
  late.suspect_iron(20.0 * 20.0);
  EXPECT_LT((late.iron_ut() - early.iron_ut()).norm(), 0.5);
  EXPECT_NEAR(late.offset_rad(), early.offset_rad(), to_radians(1.0));
  EXPECT_NEAR(late.covariance()(2, 2) / early.covariance()(2, 2), 1.0, 0.2);
}

TEST(DeadReckoningField, AMagnetNearbySaysNothingOfHeading) {
  // One that could be the earth's by its strength, and one stronger than the earth's is anywhere.
  for (const Vector2d& magnet : {Vector2d(50.0, 0.0), Vector2d(150.0, 80.0)}) {
    Walker walker{.zero_rad = 0.3};
    DeadReckoning track;
    for (int i = 0; i < 60; ++i) walker.step(track, 0.0, {0.0, 0.0});
    const double before = track.offset_rad();
    for (int i = 0; i < 10; ++i) walker.step(track, 0.0, magnet);
    EXPECT_NEAR(track.offset_rad(), before, to_radians(2.0)) << magnet.transpose();
    for (int i = 0; i < 60; ++i) walker.step(track, 0.0, {0.0, 0.0});
    EXPECT_NEAR(track.offset_rad(), 0.3, to_radians(1.0)) << magnet.transpose();
    EXPECT_GE(track.field_restarts(), 1U) << magnet.transpose();
  }
}

TEST(DeadReckoningField, AFieldThatTellsHardlyANorthLeavesACovariance) {
  DeadReckoning track;
  MeanField field;  // of 3 uT, where steel may hide 7
  field.horizontal_ut = Vector2d(3.0, 0.0);
  DeadReckonedStep step;
  step.length_m = 0.7;
  for (int i = 0; i < 20; ++i) {
    track.take(field);
    track.add(step);
    const Eigen::Matrix3d covariance = track.covariance();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
    EXPECT_GE(solver.eigenvalues()[0], -1e-9) << "step " << i;
    EXPECT_LE(covariance(2, 2), kPi * kPi / 3.0 + 1e-9);
  }
}

TEST(DeadReckoningField, AWrongFirstFieldIsCorrectedOnceItIsContradicted) {
  // A desk of steel for three seconds of standing, then the earth's field: without a doubt of the
  // first, it would be the earth's that is taken for a disturbance.
  Walker walker{.zero_rad = 0.3};
  DeadReckoning track;
  for (int i = 0; i < 12; ++i) walker.step(track, 0.0, {-30.0, -10.0}, 0.0, 0.0);
  EXPECT_GT(std::abs(wrap_pi(track.offset_rad() - 0.3)), 0.5);
  for (int i = 0; i < 100; ++i) walker.step(track, 0.0, {0.0, 0.0});
  EXPECT_NEAR(track.offset_rad(), 0.3, to_radians(5.0));
}

TEST(DeadReckoningField, ANoisyMagnetometerIsAveragedAndNotTakenForMagnets) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 6.0);
  Walker walker{.zero_rad = 0.3};
  DeadReckoning track;
  for (int i = 0; i < 200; ++i) walker.step(track, 0.0, {noise(random), noise(random)});
  EXPECT_LE(track.field_restarts(), 10U);
  EXPECT_NEAR(track.offset_rad(), 0.3, to_radians(5.0));
}

TEST(DeadReckoningField, ATurnOfUnknownSizeIsFoundFromTheField) {
  Walker walker{.zero_rad = 0.3};
  DeadReckoning track;
  for (int i = 0; i < 30; ++i) walker.step(track, 0.0, {0.0, 0.0});
  RelativeMotion gap;
  gap.elapsed_s = 10.0;
  gap.blind_rad2 = kPi * kPi;
  track.pass(gap);
  walker.zero_rad = 2.5;  // the body turned meanwhile and the gyroscope did not see it
  for (int i = 0; i < 30; ++i) walker.step(track, 1.0, {0.0, 0.0});
  EXPECT_NEAR(wrap_pi(track.offset_rad() - 2.5), 0.0, to_radians(3.0));
  EXPECT_LT((track.position_m() - walker.truth_m).norm(), 2.0);
}

TEST(DeadReckoningField, ErrorsAreAsLargeAsTheCovarianceSays) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const FieldConfig field;
  double position_nees = 0.0;
  double yaw_nees = 0.0;
  constexpr int kWalks = 200;
  for (int n = 0; n < kWalks; ++n) {
    Walker walker{.zero_rad = 3.0 * normal(random)};
    const double drift = DeadReckoningConfig{}.bias_sigma_radps * normal(random);
    walker.iron_ut = field.iron_sigma_ut * Vector3d(normal(random), normal(random), 0.0);
    const double length = 0.7 * (1.0 + 0.1 * normal(random));
    const double forward = 0.05 * normal(random);
    Vector2d disturbance = field.disturbance_sigma_ut * Vector2d(normal(random), normal(random));
    DeadReckoning track;
    Vector2d truth = Vector2d::Zero();
    for (int i = 0; i < 120; ++i) {
      const double kept = std::exp(-(0.7 + 0.5 * field.standing_mps) / field.disturbance_length_m);
      disturbance = kept * disturbance + std::sqrt(1.0 - kept * kept) * field.disturbance_sigma_ut *
                                             Vector2d(normal(random), normal(random));
      const double yaw = i < 50 ? 0.0 : 0.5 * kPi;
      walker.zero_rad += 0.5 * drift;
      const Vector2d noise = field.noise_ut * Vector2d(normal(random), normal(random));
      walker.step(track, yaw, disturbance + noise);
      truth += length * Vector2d(std::cos(yaw + forward), std::sin(yaw + forward));
    }
    const Eigen::Matrix3d p = track.covariance();
    const Vector2d error = track.position_m() - truth;
    position_nees += error.dot(p.topLeftCorner<2, 2>().inverse() * error) / 2.0;
    const double turned = wrap_pi(track.offset_rad() - walker.zero_rad);
    yaw_nees += turned * turned / p(2, 2);
  }
  // Chi squared of 400 and of 200 degrees of freedom: 1 +- 0.07 and 1 +- 0.1 (1 sigma).
  EXPECT_NEAR(position_nees / kWalks, 1.0, 0.25);
  EXPECT_NEAR(yaw_nees / kWalks, 1.0, 0.3);
}

/// Gravity shows the bias of the level axes; that of the vertical is as large.
TEST(DeadReckoningField, ABadGyroscopesBiasIsFound) {
  constexpr double kBias = 0.05;
  constexpr double kPeriod = 0.25;
  DeadReckoning dead_reckoning;
  double drifted = 0.0;
  for (int i = 0; i < 400; ++i) {
    RelativeMotion motion;
    motion.elapsed_s = kPeriod;
    motion.up_s = {0.0, 0.0, kPeriod};
    if (i < 20) motion.bias_change_radps = {kBias / 20.0, -kBias / 20.0, 0.0};
    dead_reckoning.pass(motion);
    drifted += kBias * kPeriod;
    MeanField field;
    field.horizontal_ut = Eigen::Rotation2Dd(drifted) * Eigen::Vector2d(0.0, 30.0);
    field.up_ut = -40.0;
    field.level_rows =
        Eigen::Rotation2Dd(drifted).toRotationMatrix() * Eigen::Matrix<double, 2, 3>::Identity();
    dead_reckoning.take(field);
    if (i % 2 == 0) dead_reckoning.add({.length_m = 0.7, .relative_yaw_rad = drifted});
  }
  EXPECT_NEAR(wrap_pi(dead_reckoning.offset_rad() + drifted), 0.0, 0.2);
}

}  // namespace
}  // namespace vpdr::pdr
