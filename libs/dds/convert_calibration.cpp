#include "calibration/board_calibration.hpp"
#include "dds/convert.hpp"
#include "dds/detail/convert_geometry.hpp"
#include "vpdr_msgs.h"

namespace vpdr::dds {
namespace {

using detail::from_rows;
using detail::to_rows;

constexpr double kUtPerTesla = 1e6;

/// Axes folded in: A (P r - b) = A P (r - P^T b).
Eigen::Matrix3d scale_of(const calibration::SensorCalibration& sensor) {
  return sensor.correction.matrix * sensor.axes;
}
Eigen::Vector3d bias_of(const calibration::SensorCalibration& sensor) {
  return sensor.axes.transpose() * sensor.correction.bias;
}

void set(const Eigen::Matrix3d& scale, const Eigen::Vector3d& bias,
         calibration::SensorCalibration& out) {
  out.axes.setIdentity();
  out.correction = {scale, bias};
}

}  // namespace

void to_msg(const calibration::BoardCalibration& board, TimestampNs stamp_ns,
            vpdr_msgs::msg::Calibration& out) {
  detail::to_msg(stamp_ns, Frame::kImuLink, out.header());
  out.board(board.board);
  out.serial(board.serial);
  detail::to_xyz(bias_of(board.gyroscope), out.gyroscope_bias());
  to_rows<3>(scale_of(board.gyroscope), out.gyroscope_scale());
  detail::to_xyz(board.gyroscope.axes.transpose() * board.gyroscope.bias_slope,
                 out.gyroscope_bias_slope());
  out.gyroscope_temperature(board.gyroscope.temperature_c);
  out.gyroscope_temperature_span(board.gyroscope.temperature_span_c);
  detail::to_xyz(bias_of(board.accelerometer), out.accelerometer_bias());
  to_rows<3>(scale_of(board.accelerometer), out.accelerometer_scale());
  detail::to_xyz(bias_of(board.magnetometer) / kUtPerTesla, out.magnetometer_bias());
  to_rows<3>(scale_of(board.magnetometer), out.magnetometer_scale());
  to_rows<3>(board.mount.body_from_board, out.mount());
  out.field_strength(board.magnetometer.field_ut / kUtPerTesla);
  out.field_dip(board.magnetometer.dip_rad);
}

void from_msg(const vpdr_msgs::msg::Calibration& msg, calibration::BoardCalibration& out) {
  out.board = msg.board();
  out.serial = msg.serial();
  set(from_rows<3>(msg.gyroscope_scale()), detail::from_xyz(msg.gyroscope_bias()), out.gyroscope);
  out.gyroscope.bias_slope = detail::from_xyz(msg.gyroscope_bias_slope());
  out.gyroscope.temperature_c = msg.gyroscope_temperature();
  out.gyroscope.temperature_span_c = msg.gyroscope_temperature_span();
  set(from_rows<3>(msg.accelerometer_scale()), detail::from_xyz(msg.accelerometer_bias()),
      out.accelerometer);
  set(from_rows<3>(msg.magnetometer_scale()),
      detail::from_xyz(msg.magnetometer_bias()) * kUtPerTesla, out.magnetometer);
  out.mount.body_from_board = from_rows<3>(msg.mount());
  out.magnetometer.field_ut = msg.field_strength() * kUtPerTesla;
  out.magnetometer.dip_rad = msg.field_dip();
}

}  // namespace vpdr::dds
