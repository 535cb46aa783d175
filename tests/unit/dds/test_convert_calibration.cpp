#include <gtest/gtest.h>

#include "calibration/board_calibration.hpp"
#include "dds/convert.hpp"
#include "unit/dds/random_values.hpp"
#include "vpdr_msgs.h"

namespace vpdr::dds {
namespace {

using test::Random;

TEST(Convert, CalibrationMeansTheSameOnBothSides) {
  Random random;
  calibration::BoardCalibration board;
  board.serial = "17";
  board.magnetometer.axes = Eigen::Vector3d(-1, 1, -1).asDiagonal();
  board.magnetometer.correction = {random.matrix<Eigen::Matrix3d>(), random.vector()};
  board.accelerometer.correction = {random.matrix<Eigen::Matrix3d>(), random.vector()};
  board.gyroscope.correction = {random.matrix<Eigen::Matrix3d>(), random.vector()};
  board.gyroscope.axes = Eigen::Vector3d(1, -1, -1).asDiagonal();
  board.gyroscope.bias_slope = random.vector();
  board.gyroscope.temperature_c = 25.0;
  board.gyroscope.temperature_span_c = 20.0;
  board.mount.body_from_board = random.rotation().toRotationMatrix();
  board.magnetometer.field_ut = 48.0;
  vpdr_msgs::msg::Calibration message;
  to_msg(board, kNsPerSecond, message);
  EXPECT_DOUBLE_EQ(message.field_strength(), 48e-6);
  calibration::BoardCalibration back;
  from_msg(message, back);
  const Eigen::Vector3d read = random.vector();
  EXPECT_TRUE(back.magnetometer.apply(read).isApprox(board.magnetometer.apply(read)));
  EXPECT_TRUE(back.accelerometer.apply(read).isApprox(board.accelerometer.apply(read)));
  EXPECT_TRUE(back.gyroscope.apply(read).isApprox(board.gyroscope.apply(read)));
  // The slope stands where the bias stands: in the sensor's own axes, before the scale.
  EXPECT_TRUE((back.gyroscope.correction.matrix * back.gyroscope.bias_change(31.0))
                  .isApprox(board.gyroscope.correction.matrix * board.gyroscope.bias_change(31.0)));
  EXPECT_EQ(back.mount.body_from_board, board.mount.body_from_board);
  EXPECT_EQ(back.serial, "17");
}

}  // namespace
}  // namespace vpdr::dds
