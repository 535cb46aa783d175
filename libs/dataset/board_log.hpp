#pragma once
// Logs as sensor boards and phones write them, before anything is known of axes, signs and bias:
// what calibration reads. Unlike a recording's tables they have units of their own.
//
//   t_s,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps,temp_C     what boards send to imu_gateway
//   Time (s),Gyroscope X (deg/s),...                    x-io's
//   0.1538 -0.0345 3.81073 8.860977                     no header: seconds and three numbers, of
//   the
//                                                       sensor that the file is named for
//                                                       (accelerometer, gyroscope, magnetometer),
//                                                       in m/s^2, rad/s, uT
//
// Fields are set apart by commas, semicolons, tabs or blanks. Not thread-safe, reentrant.
#include <filesystem>
#include <vector>

#include "core/sensor_streams.hpp"

namespace vpdr::dataset {

/// Streams with what was refused on the way: rows with a field that is no number, or whose stamp
/// is not newer than the one before.
struct BoardLog {
  SensorStreams streams;
  std::uint64_t refused_rows = 0;
};

/// Reads one log, `file` itself or `file`.xz. Throws FileFault naming file and line where the
/// header or every row is unreadable.
BoardLog read_board_log(const std::filesystem::path& file);

/// Reads several, one after the other in time: a file that brings a sensor which the files before
/// it brought already was written later than those, and gets stamps after theirs.
BoardLog read_board_logs(const std::vector<std::filesystem::path>& files);

}  // namespace vpdr::dataset
