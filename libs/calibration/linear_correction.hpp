#pragma once
// From what a three-axis sensor reads to what is true: true = matrix (read - bias).
#include <Eigen/Core>
#include <Eigen/LU>

namespace vpdr::calibration {

/// Bias, scale and misalignment of one sensor, in the sensor's unit.
struct LinearCorrection {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();

  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& read) const {
    return matrix * (read - bias);
  }
  /// What the sensor reads where `truth` is.
  [[nodiscard]] Eigen::Vector3d undo(const Eigen::Vector3d& truth) const {
    return matrix.inverse() * truth + bias;
  }
};

}  // namespace vpdr::calibration
