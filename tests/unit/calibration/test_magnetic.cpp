// Magnetometer, sphere coverage and the gyroscope's alignment against synthetic truth.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include "calibration/calibrate.hpp"
#include "calibration/turns.hpp"
#include "core/axis_map.hpp"
#include "unit/calibration/synthetic_board.hpp"

namespace vpdr::calibration {
namespace {

using testing::all_ways;
using testing::attitudes;
using testing::true_streams;
using V = Eigen::Vector3d;

Eigen::Matrix3d soft_iron() {
  Eigen::Matrix3d m;
  m << 1.08, 0.03, -0.02, 0.03, 0.95, 0.01, -0.02, 0.01, 0.98;
  return m / std::cbrt(m.determinant());
}

SensorStreams turned(int poses = 60) { return true_streams(attitudes(all_ways(poses), 0.0, 2.0)); }

TEST(SphereCoverage, CountsCellsAndFindsTheHole) {
  SphereCoverage coverage;
  EXPECT_EQ(coverage.share(), 0.0);
  for (int i = 0; i < 2000; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / 2000.0;
    const double r = std::sqrt(1.0 - z * z);
    if (z < 0.5) coverage.add({r * std::cos(2.39996 * i), r * std::sin(2.39996 * i), z});
  }
  EXPECT_NEAR(coverage.share(), 0.8, 0.06);  // three quarters, and the cells on the rim
  EXPECT_GT(coverage.largest_hole().z(), 0.9);
}

TEST(DirectionName, ByHand) {
  EXPECT_EQ(direction_name({0, 0, -3}), "-z");
  EXPECT_EQ(direction_name({1, 0.2, 0.9}), "+x+z");
  EXPECT_EQ(direction_name({-1, 1, 1}), "-x+y+z");
}

TEST(Magnetometer, FindsHardAndSoftIron) {
  SensorStreams streams = turned();
  const V hard(58.0, -74.0, 411.0);
  for (TimedVector& m : streams.field_ut) m.value = soft_iron().inverse() * m.value + hard;
  const auto found = calibrate_magnetometer(streams.field_ut);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT((found.value().correction.matrix - soft_iron()).norm(), 0.01);
  EXPECT_LT((found.value().correction.bias - hard).norm(), 0.2);
  EXPECT_NEAR(found.value().field_ut, 48.0, 0.2);
  EXPECT_GT(found.value().coverage, 0.8);
  EXPECT_LT(found.value().rms, 0.006);
}

TEST(Magnetometer, APassingMagnetDoesNotCount) {
  SensorStreams streams = turned();
  const std::size_t size = streams.field_ut.size();
  for (std::size_t i = size / 3; i < size / 3 + size / 20; ++i) {
    streams.field_ut[i].value += V(20, 30, -10);
  }
  const auto found = calibrate_magnetometer(streams.field_ut);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(found.value().correction.bias.norm(), 0.5);
  EXPECT_NEAR(found.value().outliers, 0.05, 0.02);
}

TEST(Magnetometer, QuickTurnsDoNotShortenTheField) {
  // 5 rad/s read 50 times a second: a mean over 60 ms is over 0.2 rad, 1 - cos(0.1) * 2 / 3 - 1 / 3
  // too short.
  std::vector<TimedVector> field;
  for (int i = 0; i < 200; ++i) {
    field.push_back({i * 20'000'000LL, 50.0 * V(std::cos(0.1 * i), std::sin(0.1 * i), 0.0)});
  }
  for (const TimedVector& mean : thin_out(field, V::Zero(), {})) {
    ASSERT_NEAR(mean.value.norm(), 50.0, 1e-9);
  }
  // Slow ones are averaged: each of these neighbours is 1.5 uT off to one side or the other.
  for (int i = 0; i < 200; ++i) {
    const auto k = static_cast<std::size_t>(i);
    field[k].value = V(50.0, 0.3 * i, i % 2 == 0 ? 1.5 : -1.5);
  }
  const auto means = thin_out(field, V::Zero(), {});
  ASSERT_GT(means.size(), 5U);
  for (std::size_t i = 1; i + 1 < means.size(); ++i) {
    ASSERT_LT(std::abs(means[i].value.z()), 0.7) << i;
  }
}

TEST(Magnetometer, RefusesAHalfTurnedBoardAndSaysWhichWay) {
  SensorStreams streams = turned(200);
  std::erase_if(streams.field_ut, [](const TimedVector& m) { return m.value.x() < 5.0; });
  const auto found = calibrate_magnetometer(streams.field_ut);
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("-x"), std::string::npos) << found.error().message;
}

TEST(Magnetometer, RefusesABoardAtRestAndAFieldThatIsNotTheEarths) {
  const SensorStreams still = true_streams(attitudes({Eigen::Quaterniond::Identity()}, 5.0, 0.0));
  EXPECT_FALSE(calibrate_magnetometer(still.field_ut));
  EXPECT_FALSE(calibrate_magnetometer({}));
  SensorStreams gauss = turned();
  for (TimedVector& m : gauss.field_ut) m.value *= 0.01;
  const auto found = calibrate_magnetometer(gauss.field_ut);
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("unit"), std::string::npos) << found.error().message;
}

TEST(RateAlignment, ByHand) {
  // Turned by 0.02 rad about z, x goes to -y in the board's axes: d' = R^T d.
  RateAlignment alignment;
  const double angle = 2.0 * std::tan(0.01);
  const double c = std::cos(0.02);
  const double s = std::sin(0.02);
  alignment.add(V(0, 0, angle), V(1, 0, 0), V(c, -s, 0), 0.01);
  alignment.add(V(0, 0, angle), V(0, 1, 0), V(s, c, 0), 0.01);
  EXPECT_FALSE(alignment.solve()) << "one axis tells a third of the matrix";
  alignment.add(V(angle, 0, 0), V(0, 1, 0), V(0, c, -s), 0.01);
  alignment.add(V(angle, 0, 0), V(0, 0, 1), V(0, s, c), 0.01);
  alignment.add(V(0, angle, 0), V(0, 0, 1), V(-s, 0, c), 0.01);
  alignment.add(V(0, angle, 0), V(1, 0, 0), V(c, 0, s), 0.01);
  const auto solution = alignment.solve();
  ASSERT_TRUE(solution);
  EXPECT_LT((solution->direction_from_gyro - Eigen::Matrix3d::Identity()).norm(), 1e-9);
}

TEST(RateAlignment, FindsFlippedAxesAndScaleInTurns) {
  SensorStreams streams = turned();
  Eigen::Matrix3d flips = Eigen::Vector3d(-1.0, 1.02, 1.0).asDiagonal();
  for (TimedVector& rate : streams.rate_radps)
    rate.value = flips.inverse() * rate.value + V(0.1, 0, 0);
  const auto solution = align_rates(streams.rate_radps, V(0.1, 0, 0), streams.field_ut);
  ASSERT_TRUE(solution);
  EXPECT_LT((solution->direction_from_gyro - flips).norm(), 0.02);
  EXPECT_LT(solution->direction_from_gyro.determinant(), 0.0);
}

TEST(IntegratedTurn, ByHand) {
  std::vector<TimedVector> rates;
  for (int i = 0; i <= 100; ++i) rates.push_back({i * 10'000'000, V(0.5, 0, -1.0)});
  EXPECT_NEAR((integrated_turn(rates, 0, 2 * kNsPerSecond) - V(0.5, 0, -1)).norm(), 0.0, 1e-12);
}

TEST(Dip, IsTheFieldsAngleBelowTheHorizon) {
  const SensorStreams streams = turned();
  const auto dip = measure_dip(streams.field_ut, streams.force_mps2);
  ASSERT_TRUE(dip);
  EXPECT_NEAR(dip->angle_rad, to_radians(62.0), 0.002);
  EXPECT_LT(dip->sigma_rad, 0.01);
}

TEST(CalibrateMag, FindsWhichAxisIsWhichAndTheSmallAngles) {
  SensorStreams streams = turned();
  // The sensor lies turned by 90 degrees about z on the board, and 3 degrees askew.
  const Eigen::Matrix3d sensor_from_board =
      Eigen::AngleAxisd(to_radians(3.0), V::UnitX()).toRotationMatrix() *
      parse_axis_map("+y,-x,+z", false).value();
  for (TimedVector& m : streams.field_ut) m.value = sensor_from_board * m.value + V(5, 6, 7);
  const std::vector<TimedVector> truth = turned().field_ut;
  const auto found = calibrate_mag(streams, {}, {.date = "2024-01-01T00:00:00Z", .first_up = {}});
  ASSERT_TRUE(found) << found.error().message;
  const MagnetometerSection& section = found.value().board.magnetometer;
  EXPECT_EQ(axis_map_name(section.axes), "-y,+x,+z");
  EXPECT_NEAR(section.dip_rad, to_radians(62.0), 0.005);
  double worst = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const V error = section.apply(streams.field_ut[i].value) - truth[i].value;
    worst = std::max(worst, error.norm());
  }
  EXPECT_LT(worst, 0.5);
}

TEST(CalibrateMag, TurnsTheSignsByTheHemisphere) {
  SensorStreams streams = turned();
  for (TimedVector& m : streams.field_ut) m.value = -m.value;
  const auto north = calibrate_mag(streams, {}, {});
  ASSERT_TRUE(north);
  EXPECT_EQ(axis_map_name(north.value().board.magnetometer.axes), "-x,-y,-z");
  EXPECT_GT(north.value().board.magnetometer.dip_rad, 1.0);
  EXPECT_FALSE(north.value().notes.empty());
  CalibrationOptions options;
  options.southern = true;
  const auto south = calibrate_mag(streams, {}, options);
  ASSERT_TRUE(south);
  EXPECT_EQ(axis_map_name(south.value().board.magnetometer.axes), "+x,+y,+z");
  EXPECT_LT(south.value().board.magnetometer.dip_rad, -1.0);
}

TEST(CalibrateImu, FindsTheSignOfTheAccelerometerAndTheGyroscopesAxes) {
  SensorStreams streams = true_streams(attitudes(testing::ten_poses(), 3.0, 1.5));
  for (TimedVector& f : streams.force_mps2) f.value = -f.value;
  for (TimedVector& w : streams.rate_radps) {
    w.value = V(-w.value.x(), w.value.y(), w.value.z()) + V(0.05, 0.01, 0);
  }
  CalibrationOptions options;
  options.first_up = V(0, 0, 1);
  const auto found = calibrate_imu(streams, {}, options);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(axis_map_name(found.value().board.accelerometer.axes), "-x,-y,-z");
  EXPECT_EQ(axis_map_name(found.value().board.gyroscope.axes), "-x,+y,+z");
  EXPECT_LT((found.value().board.gyroscope.correction.bias - V(-0.05, 0.01, 0)).norm(), 1e-4);
  ASSERT_FALSE(found.value().notes.empty());
  EXPECT_NE(found.value().notes.front().find("left-handed"), std::string::npos);
  options.first_up = V(1, 0, 0);
  EXPECT_FALSE(calibrate_imu(streams, {}, options));
}

}  // namespace
}  // namespace vpdr::calibration
