#pragma once
// Calibrations as a whole: from the raw streams of a board to the sections of its file. Each takes
// what is known of the board already and gives back what is known now.
#include <optional>
#include <string>
#include <vector>

#include "calibration/accelerometer.hpp"
#include "calibration/board_calibration.hpp"
#include "calibration/gyroscope.hpp"
#include "calibration/magnetometer.hpp"
#include "calibration/mount.hpp"

namespace vpdr::calibration {

struct CalibrationOptions {
  std::string date;  ///< written into the sections
  /// Direction of the board, by its sensor axes, that pointed up in the first rest: tells the sign
  /// of an accelerometer that reads minus one g upwards. nullopt: the signs are right.
  std::optional<Eigen::Vector3d> first_up;
  /// The place is in the southern hemisphere, where the field points up.
  bool southern = false;
};

/// The board's new file, and what a person should know beside it.
struct Calibrated {
  BoardCalibration board;
  std::vector<std::string> notes;
};

/// Accelerometer from the rests, gyroscope's bias, noise from the longest rest, and the gyroscope's
/// axes from the turns between.
Result<Calibrated> calibrate_imu(const SensorStreams& streams, const BoardCalibration& known,
                                 const CalibrationOptions& options);

/// Magnetometer from turning the board every way; its axes and its misalignment to the gyroscope's;
/// strength and dip of the field.
Result<Calibrated> calibrate_mag(const SensorStreams& streams, const BoardCalibration& known,
                                 const CalibrationOptions& options);

/// The way the board is worn, from standing and walking.
Result<Calibrated> calibrate_mount(const SensorStreams& streams, const BoardCalibration& known,
                                   const CalibrationOptions& options);

/// The streams in board axes as `board` corrects them.
SensorStreams corrected(const SensorStreams& streams, const BoardCalibration& board);

}  // namespace vpdr::calibration
