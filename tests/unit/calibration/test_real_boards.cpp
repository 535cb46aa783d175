// Calibration of real boards: MPU6050 + HMC5883L and a phone, from their own logs.
#include <gtest/gtest.h>

#include "calibration/calibrate.hpp"
#include "calibration/turns.hpp"
#include "core/axis_map.hpp"
#include "core/rotation.hpp"
#include "dataset/board_log.hpp"
#include "support/recordings.hpp"

namespace vpdr::calibration {
namespace {

namespace fs = std::filesystem;

SensorStreams board_streams(const fs::path& root, const std::vector<std::string>& names) {
  std::vector<fs::path> files;
  for (const std::string& name : names) {
    const fs::path stem = root / "boards/mpu6050_hmc5883l_sunsided" / name;
    files.emplace_back(stem.string() + "_mpu6050.csv");
    files.emplace_back(stem.string() + "_hmc5883l.csv");
  }
  return dataset::read_board_logs(files).streams;
}

/// Everything that the logs tell of the board: rests and turns, then the field.
Calibrated whole_board(const fs::path& root) {
  const SensorStreams rests = board_streams(
      root, {"unmoved-with-x-pointing-forward", "unmoved-with-z-pointing-front-and-x-up",
             "unmoved-with-z-pointing-front-and-y-down", "full-sphere"});
  CalibrationOptions options;
  options.first_up = Eigen::Vector3d::UnitZ();
  const auto imu = calibrate_imu(rests, {}, options);
  EXPECT_TRUE(imu) << imu.error().message;
  if (!imu) return {};
  const auto mag = calibrate_mag(board_streams(root, {"full-sphere"}), imu.value().board, options);
  EXPECT_TRUE(mag) << mag.error().message;
  return mag ? mag.value() : Calibrated{};
}

/// RMS of the length's error over every single reading, share of the field.
double single_readings(const SensorStreams& streams, const BoardCalibration& board) {
  double squares = 0.0;
  for (const TimedVector& m : streams.field_ut) {
    squares += std::pow(m.value.norm() / board.magnetometer.field_ut - 1.0, 2);
  }
  return std::sqrt(squares / static_cast<double>(streams.field_ut.size()));
}

TEST(RealBoard, SphereAndRestsComeOutRound) {
  VPDR_REQUIRE_RECORDINGS(root);
  const BoardCalibration board = whole_board(root).board;
  EXPECT_GT(board.magnetometer.residual_before, 0.1);
  EXPECT_LT(board.magnetometer.residual, 0.015);
  EXPECT_GT(board.accelerometer.residual_before, 0.015);
  EXPECT_LT(board.accelerometer.residual, 0.005);
  // Somewhere in the middle latitudes of the north.
  EXPECT_NEAR(board.magnetometer.field_ut, 50.0, 6.0);
  EXPECT_NEAR(to_degrees(board.magnetometer.dip_rad), 65.0, 4.0);
}

TEST(RealBoard, EveryReadingOfTheSphereCounts) {
  VPDR_REQUIRE_RECORDINGS(root);
  const BoardCalibration board = whole_board(root).board;
  const SensorStreams sphere = corrected(board_streams(root, {"full-sphere"}), board);
  EXPECT_LT(single_readings(sphere, board), 0.015);
}

TEST(RealBoard, AxesAndSignsAreFound) {
  VPDR_REQUIRE_RECORDINGS(root);
  const BoardCalibration board = whole_board(root).board;
  // Reads minus one g upwards; the gyroscope sits half turned about z.
  EXPECT_EQ(axis_map_name(board.accelerometer.axes), "-x,-y,-z");
  EXPECT_EQ(axis_map_name(board.gyroscope.axes), "-x,-y,+z");
  EXPECT_EQ(axis_map_name(board.magnetometer.axes), "+x,+y,+z");
}

TEST(RealBoard, TurnsAboutOneAxisAreWholeTurns) {
  VPDR_REQUIRE_RECORDINGS(root);
  const BoardCalibration board = whole_board(root).board;
  for (const char* name :
       {"rotate-ccw-around-x-pointing-forward", "rotate-ccw-around-x-pointing-up",
        "rotate-ccw-around-y-pointing-left", "rotate-ccw-around-z-pointing-up"}) {
    const SensorStreams streams = corrected(board_streams(root, {name}), board);
    const auto& rates = streams.rate_radps;
    const double turns =
        integrated_turn(rates, rates.front().stamp_ns, rates.back().stamp_ns + 1).norm() /
        (2.0 * kPi);
    EXPECT_NEAR(turns, 2.0, 0.04) << name;
  }
}

TEST(RealBoard, DriftOfTheGyroscopeOverTenMinutesIsExplained) {
  VPDR_REQUIRE_RECORDINGS(root);
  const SensorStreams streams = board_streams(root, {"unmoved-with-x-pointing-forward-10min"});
  const auto bias = calibrate_gyroscope(streams, find_rests(streams));
  ASSERT_TRUE(bias) << bias.error().message;
  // Temperature takes a part off; what is left is white noise of the pieces and little more.
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_LE(bias.value().residual_radps[axis], bias.value().wander_radps[axis]);
    EXPECT_LT(bias.value().residual_radps[axis], 1.6 * bias.value().noise_radps[axis]) << axis;
  }
  EXPECT_LT(bias.value().residual_radps.y(), 0.95 * bias.value().wander_radps.y());
}

class RealPhone : public ::testing::TestWithParam<const char*> {};

TEST_P(RealPhone, AccelerometerGyroscopeAndMagnetometer) {
  VPDR_REQUIRE_RECORDINGS(root);
  const fs::path folder = root / "boards/phone_calibration";
  const std::string suffix = std::string("_Nexus5_") + GetParam();
  const SensorStreams rests =
      dataset::read_board_log(folder / ("calib_acc" + suffix) / "accelerometer.txt").streams;
  const auto force = calibrate_accelerometer(rests, find_rests(rests));
  ASSERT_TRUE(force) << force.error().message;
  EXPECT_LT(force.value().rms, 0.005);
  EXPECT_GT(force.value().rms_before, 0.008);

  const SensorStreams still =
      dataset::read_board_log(folder / ("calib_gyr" + suffix) / "gyroscope.txt").streams;
  const auto bias = calibrate_gyroscope(still, find_rests(still));
  ASSERT_TRUE(bias) << bias.error().message;
  EXPECT_NEAR(bias.value().bias_radps.z(), 0.073, 0.005);

  const fs::path turned = folder / ("calib_mag" + suffix);
  const SensorStreams sphere =
      dataset::read_board_logs({turned / "accelerometer.txt", turned / "magnetometer.txt"}).streams;
  const auto mag = calibrate_mag(sphere, {}, {});
  ASSERT_TRUE(mag) << mag.error().message;
  EXPECT_LT(mag.value().board.magnetometer.residual, 0.015);
  EXPECT_GT(mag.value().board.magnetometer.residual_before, 0.05);
  EXPECT_NEAR(mag.value().board.magnetometer.field_ut, 47.0, 1.0);
  EXPECT_LT(single_readings(corrected(sphere, mag.value().board), mag.value().board), 0.015);
}

INSTANTIATE_TEST_SUITE_P(Days, RealPhone, ::testing::Values("d1", "d2", "d3"));

}  // namespace
}  // namespace vpdr::calibration
