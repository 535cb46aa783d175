#pragma once
// A board's calibration on the way of its samples. Pure; allocates nothing.
#include <optional>

#include "calibration/board_calibration.hpp"
#include "core/samples.hpp"

namespace vpdr::imu_gateway {

/// Corrects samples that a source has turned to body axes already by its own mount. A calibrated
/// mount takes the place of the source's.
class SampleCorrection {
 public:
  /// Changes nothing.
  SampleCorrection() = default;
  SampleCorrection(const calibration::BoardCalibration& board,
                   const Eigen::Matrix3d& body_from_board);

  /// `temperature_c`: of the board, where it tells.
  void apply(ImuSample& sample, std::optional<double> temperature_c) const;
  void apply(MagSample& sample) const;

 private:
  /// corrected = matrix * sample - offset.
  struct Map {
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
    Eigen::Vector3d offset = Eigen::Vector3d::Zero();
  };
  static Map map_of(const calibration::SensorCalibration& sensor,
                    const Eigen::Matrix3d& body_from_board,
                    const Eigen::Matrix3d& board_from_source);

  Map force_;
  Map rate_;
  Map field_;
  calibration::GyroscopeSection gyroscope_;
  Eigen::Matrix3d body_from_rate_ = Eigen::Matrix3d::Identity();  ///< from the gyroscope's bias
};

/// The mount that holds: the calibrated one, or the source's where there is none.
Eigen::Matrix3d mount_of(const calibration::BoardCalibration& board,
                         const Eigen::Matrix3d& source_mount);

}  // namespace vpdr::imu_gateway
