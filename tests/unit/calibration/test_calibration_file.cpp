#include <gtest/gtest.h>

#include "calibration_file/calibration_file.hpp"
#include "core/axis_map.hpp"
#include "core/errors.hpp"
#include "support/temporary_folder.hpp"

namespace vpdr::calibration {
namespace {

using vpdr::testing::TemporaryFolder;

BoardCalibration some_board() {
  BoardCalibration board;
  board.board = "MPU6050 + HMC5883L";
  board.serial = "17";
  board.accelerometer.date = "2024-05-06T07:08:09Z";
  board.accelerometer.axes = parse_axis_map("-x,-y,-z", true).value();
  board.accelerometer.correction.matrix << 1.01, 0.002, 0, 0.002, 0.99, 0.001, 0, 0.001, 1.02;
  board.accelerometer.correction.bias = {0.1, -0.2, 0.3};
  board.accelerometer.poses = 7;
  board.gyroscope.bias_slope = {1e-4, 2e-4, -3e-4};
  board.gyroscope.temperature_c = -5.5;
  board.magnetometer.axes = parse_axis_map("+y,-x,+z", false).value();
  board.magnetometer.field_ut = 48.0;
  board.magnetometer.dip_rad = -1.1;
  board.mount.body_from_board = parse_axis_map("+z,+y,-x", false).value();
  return board;
}

std::string mistake(const std::filesystem::path& file) {
  try {
    read_calibration(file);
  } catch (const ConfigurationFault& fault) {
    return fault.what();
  }
  return "";
}

TEST(CalibrationFile, ComesBackAsItWas) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "board.yaml";
  const BoardCalibration board = some_board();
  write_calibration(board, file);
  const BoardCalibration back = read_calibration(file);
  EXPECT_EQ(back.board, board.board);
  EXPECT_EQ(back.serial, board.serial);
  EXPECT_EQ(back.accelerometer.date, board.accelerometer.date);
  EXPECT_EQ(back.accelerometer.axes, board.accelerometer.axes);
  EXPECT_EQ(back.accelerometer.correction.matrix, board.accelerometer.correction.matrix);
  EXPECT_EQ(back.accelerometer.correction.bias, board.accelerometer.correction.bias);
  EXPECT_EQ(back.accelerometer.poses, 7U);
  EXPECT_EQ(back.gyroscope.bias_slope, board.gyroscope.bias_slope);
  EXPECT_EQ(back.gyroscope.temperature_c, -5.5);
  EXPECT_EQ(back.magnetometer.axes, board.magnetometer.axes);
  EXPECT_EQ(back.magnetometer.dip_rad, -1.1);
  EXPECT_EQ(back.mount.body_from_board, board.mount.body_from_board);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "board.yaml.new"));
}

TEST(CalibrationFile, NamesEveryMistake) {
  const TemporaryFolder folder;
  const std::string unknown =
      mistake(folder.write("a.yaml", "calibration:\n  acelerometer:\n    poses: 3\n"));
  EXPECT_NE(unknown.find("a.yaml:2"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("acelerometer: unknown key"), std::string::npos) << unknown;
  const std::string several = mistake(folder.write("b.yaml",
                                                   "calibration:\n"
                                                   "  accelerometer: {axes: \"+x,+x,+z\"}\n"
                                                   "  gyroscope: {matrix: [9,0,0, 0,9,0, 0,0,9]}\n"
                                                   "  mount: {body_from_board: [1,0,0, 0,1,0, "
                                                   "0,0,-1]}\n"));
  EXPECT_NE(several.find("calibration.accelerometer.axes"), std::string::npos) << several;
  EXPECT_NE(several.find("calibration.gyroscope.matrix"), std::string::npos) << several;
  EXPECT_NE(several.find("calibration.mount.body_from_board"), std::string::npos) << several;
  EXPECT_NE(mistake(folder.path() / "absent.yaml").find("absent.yaml"), std::string::npos);
}

TEST(CalibrationFile, SaysWhereItCannotBeWritten) {
  EXPECT_THROW(write_calibration({}, "/nowhere/board.yaml"), FileFault);
}

}  // namespace
}  // namespace vpdr::calibration
