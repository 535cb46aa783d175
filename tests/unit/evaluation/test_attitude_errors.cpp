#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/rotation.hpp"
#include "dataset/recording.hpp"
#include "evaluation/attitude_errors.hpp"

namespace vpdr::evaluation {
namespace {

Eigen::Quaterniond turn(double degrees, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(to_radians(degrees), axis));
}
const Eigen::Vector3d kX = Eigen::Vector3d::UnitX();
const Eigen::Vector3d kZ = Eigen::Vector3d::UnitZ();

TEST(AttitudeError, SplitsIntoHeadingAndInclination) {
  // e = Rz(30) Rx(40): w = cos 15 cos 20, z = sin 15 cos 20, so heading 30, inclination 40 and
  // total 2 acos(0.965926 * 0.939693) = 2 acos(0.907674) = 49.628 degrees.
  const Eigen::Quaterniond reference = turn(77.0, Eigen::Vector3d(1, 2, 3).normalized());
  const AttitudeError error = attitude_error(turn(30, kZ) * turn(40, kX) * reference, reference);
  EXPECT_NEAR(to_degrees(error.heading_rad), 30.0, 1e-9);
  EXPECT_NEAR(to_degrees(error.inclination_rad), 40.0, 1e-9);
  EXPECT_NEAR(to_degrees(error.total_rad), 49.6284, 1e-4);
}

TEST(AttitudeError, DoesNotDependOnSignsOrOrderOfSize) {
  const Eigen::Quaterniond reference = turn(20, kX);
  const Eigen::Quaterniond estimate = turn(-170, kZ) * reference;
  const Eigen::Quaterniond negated(-estimate.coeffs());
  for (const auto& q : {estimate, negated}) {
    EXPECT_NEAR(to_degrees(attitude_error(q, reference).heading_rad), 170.0, 1e-9);
    EXPECT_NEAR(attitude_error(q, reference).inclination_rad, 0.0, 1e-9);
  }
  EXPECT_DOUBLE_EQ(attitude_error(reference, reference).total_rad, 0.0);
}

TEST(AttitudeError, CosinesOfHalvesMultiply) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 200; ++i) {
    const Eigen::Quaterniond a =
        Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
            .normalized();
    const AttitudeError e = attitude_error(a, Eigen::Quaterniond::Identity());
    EXPECT_NEAR(std::cos(e.total_rad / 2),
                std::cos(e.heading_rad / 2) * std::cos(e.inclination_rad / 2), 1e-9);
  }
}

/// Ten seconds at 10 Hz, the estimate turned from the reference by `degrees_at(second)`.
struct Scene {
  dataset::Recording recording;
  RunDirectory run;
};
template <class Degrees>
Scene scene(Degrees degrees_at) {
  Scene s;
  s.recording.mag.resize(1);
  for (int i = 0; i <= 100; ++i) {
    const TimestampNs stamp = i * kNsPerSecond / 10;
    const Eigen::Quaterniond reference = turn(3.0 * i, kZ) * turn(10, kX);
    s.recording.truth.poses.push_back({stamp, Eigen::Vector3d::Zero(), reference});
    s.run.attitude.push_back({stamp, turn(degrees_at(i / 10.0), kZ) * reference});
  }
  return s;
}

TEST(AttitudeRmse, IsTheRootMeanSquareOfRowsThatCount) {
  // Errors 3 in the first half, 4 in the second: rows 0..49 and 50..99 count, row 100 does not.
  Scene s = scene([](double t) { return t < 5.0 ? 3.0 : 4.0; });
  s.recording.truth.movement = {{0, 10 * kNsPerSecond}};
  const auto rmse = attitude_rmse(s.run, s.recording);
  ASSERT_TRUE(rmse.has_value());
  EXPECT_EQ(rmse->samples, 100U);
  EXPECT_NEAR(rmse->heading_deg, std::sqrt((9.0 + 16.0) / 2.0), 1e-9);
  EXPECT_NEAR(rmse->total_deg, rmse->heading_deg, 1e-9);
  EXPECT_NEAR(rmse->inclination_deg, 0.0, 1e-6);
}

TEST(AttitudeRmse, LeavesOutFaultsStillnessAndUnknownReference) {
  Scene s = scene([](double t) { return t < 5.0 ? 3.0 : 40.0; });
  s.recording.truth.movement = {{0, 9 * kNsPerSecond}};
  s.recording.about.reference_faults = {{5 * kNsPerSecond, 8 * kNsPerSecond}};
  for (int i = 80; i <= 100; ++i) {
    s.recording.truth.poses[static_cast<std::size_t>(i)].world_from_sensor.coeffs().setConstant(
        std::numeric_limits<double>::quiet_NaN());
  }
  const auto rmse = attitude_rmse(s.run, s.recording);
  ASSERT_TRUE(rmse.has_value());
  EXPECT_EQ(rmse->samples, 50U);
  EXPECT_NEAR(rmse->heading_deg, 3.0, 1e-9);
}

TEST(AttitudeRmse, BodyAttitudesMeetSensorTruthThroughTheMount) {
  Scene s = scene([](double) { return 0.0; });
  s.recording.about.mount = *dataset::mount_from_axes("+y", "+z");
  const Eigen::Quaterniond sensor_from_body(s.recording.about.mount.transpose());
  for (StampedAttitude& row : s.run.attitude) {
    row.world_from_body = row.world_from_body * sensor_from_body;
  }
  EXPECT_NEAR(attitude_rmse(s.run, s.recording)->total_deg, 0.0, 1e-6);
  dataset::apply_mount(s.recording);
  EXPECT_NEAR(attitude_rmse(s.run, s.recording)->total_deg, 0.0, 1e-6);
}

TEST(AttitudeRmse, InterpolatesBetweenEstimatesButNotAcrossGaps) {
  Scene s = scene([](double) { return 0.0; });
  // Estimates every 0.4 s from 0 to 4 s, then one at 10 s: truth after 4 s and before 10 s has
  // none.
  std::vector<StampedAttitude> sparse;
  for (std::size_t i = 0; i <= 40; i += 4) sparse.push_back(s.run.attitude[i]);
  sparse.push_back(s.run.attitude[100]);
  s.run.attitude = sparse;
  const auto rmse = attitude_rmse(s.run, s.recording);
  EXPECT_EQ(rmse->samples, 42U);
  EXPECT_NEAR(rmse->total_deg, 0.0, 1e-6);
}

TEST(AttitudeRmse, WithoutMagnetometerYawHasNoZero) {
  Scene s = scene([](double t) { return t < 5.05 ? 99.0 : 101.0; });
  s.recording.mag.clear();
  const auto rmse = attitude_rmse(s.run, s.recording);
  EXPECT_TRUE(rmse->heading_aligned);
  EXPECT_NEAR(rmse->heading_deg, 1.0, 1e-3);
}

TEST(AttitudeRmse, NothingToCompareIsNoFigure) {
  Scene s = scene([](double) { return 0.0; });
  s.run.attitude.clear();
  EXPECT_FALSE(attitude_rmse(s.run, s.recording).has_value());
}

}  // namespace
}  // namespace vpdr::evaluation
