#pragma once
// Settings of imu_gateway.
#include <cstdint>
#include <string>
#include <vector>

#include "config/binder.hpp"
#include "imu_gateway/core/make_parser.hpp"

namespace vpdr::imu_gateway {

/// Bound as `imu_gateway.*`. Exactly one source is chosen: recording, simulation, serial
/// device or ROS topic.
struct GatewaySettings {
  std::string recording;  ///< folder, see docs/recordings.md
  bool simulate = false;
  std::uint64_t simulation_seed = 1;
  double simulation_duration_s = 120.0;
  double playback_rate = 1.0;      ///< 0: as fast as nothing is lost
  double playback_window_s = 0.5;  ///< sensor time by which the slowest service may lag
  std::string calibration;         ///< file of the board, see docs/calibration.md; empty: none
  double expected_rate_hz = 0.0;   ///< of the inertial samples; 0: any
  std::string mount;               ///< axis map; empty: the calibrated, the recording's, or none
  std::string serial_device;
  std::uint32_t serial_baud = 115200;
  Protocol serial_protocol = Protocol::kText;
  std::vector<std::string> serial_lines;  ///< column lists; empty: the board sends header lines
  Separator serial_separator = Separator::kAuto;
  double wit_acceleration_range_g = 16.0;
  double wit_rate_range_dps = 2000.0;
  double serial_field_unit_ut = 0.0;  ///< 0: the protocol's own
  std::string accelerometer_axes = "+x,+y,+z";
  std::string gyroscope_axes = "+x,+y,+z";
  std::string magnetometer_axes = "+x,+y,+z";
  std::string ros_imu;  ///< topic by its ROS name
  std::string ros_mag;
  std::string ros_pressure;
  std::string ros_temperature;
  bool ros_restamp = false;
};

void bind(config::Binder& binder, GatewaySettings& settings);

}  // namespace vpdr::imu_gateway
