#include "imu_gateway/core/sample_correction.hpp"

namespace vpdr::imu_gateway {

Eigen::Matrix3d mount_of(const calibration::BoardCalibration& board,
                         const Eigen::Matrix3d& source_mount) {
  return board.mount.date.empty() ? source_mount : board.mount.body_from_board;
}

SampleCorrection::SampleCorrection(const calibration::BoardCalibration& board,
                                   const Eigen::Matrix3d& body_from_board) {
  const Eigen::Matrix3d mount = mount_of(board, body_from_board);
  const Eigen::Matrix3d board_from_source = body_from_board.transpose();
  force_ = map_of(board.accelerometer, mount, board_from_source);
  rate_ = map_of(board.gyroscope, mount, board_from_source);
  field_ = map_of(board.magnetometer, mount, board_from_source);
  gyroscope_ = board.gyroscope;
  body_from_rate_ = mount * board.gyroscope.correction.matrix;
}

SampleCorrection::Map SampleCorrection::map_of(const calibration::SensorCalibration& sensor,
                                               const Eigen::Matrix3d& body_from_board,
                                               const Eigen::Matrix3d& board_from_source) {
  const Eigen::Matrix3d corrected = body_from_board * sensor.correction.matrix;
  return {corrected * sensor.axes * board_from_source, corrected * sensor.correction.bias};
}

void SampleCorrection::apply(ImuSample& sample, std::optional<double> temperature_c) const {
  sample.specific_force_mps2 = force_.matrix * sample.specific_force_mps2 - force_.offset;
  if (!sample.has_angular_velocity) return;
  sample.angular_velocity_radps = rate_.matrix * sample.angular_velocity_radps - rate_.offset;
  if (!temperature_c) return;
  sample.angular_velocity_radps -= body_from_rate_ * gyroscope_.bias_change(*temperature_c);
}

void SampleCorrection::apply(MagSample& sample) const {
  sample.field_ut = field_.matrix * sample.field_ut - field_.offset;
}

}  // namespace vpdr::imu_gateway
