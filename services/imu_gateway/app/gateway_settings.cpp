#include "imu_gateway/app/gateway_settings.hpp"

namespace vpdr::imu_gateway {

namespace {

void bind_protocol(config::Binder& binder, GatewaySettings& s) {
  binder.choice("serial.protocol", s.serial_protocol,
                {{"text", Protocol::kText},
                 {"xio", Protocol::kXio},
                 {"wit", Protocol::kWit},
                 {"vpdr", Protocol::kVpdr}},
                "what the board sends: text lines, x-io messages, WitMotion 0x55 frames, frames "
                "of docs/board_protocol.md");
  binder.text_list("serial.lines", s.serial_lines,
                   "columns of each kind of line (text); empty: the board sends header lines");
  binder.choice("serial.separator", s.serial_separator,
                {{"auto", Separator::kAuto},
                 {"comma", Separator::kComma},
                 {"semicolon", Separator::kSemicolon},
                 {"tab", Separator::kTab},
                 {"space", Separator::kSpace}},
                "what is between two columns (text)");
  binder.number("serial.acceleration_range_g", s.wit_acceleration_range_g, config::above(0), "g",
                "full scale of the accelerometer as set on the board (wit)");
  binder.number("serial.rate_range_dps", s.wit_rate_range_dps, config::above(0), "deg/s",
                "full scale of the gyroscope as set on the board (wit)");
  binder.number("serial.field_unit_ut", s.serial_field_unit_ut, config::at_least(0), "uT",
                "one count (wit) or unit (xio) of the magnetometer; 0: 0.1 (wit), 50 (xio)");
}

}  // namespace

void bind(config::Binder& binder, GatewaySettings& s) {
  using config::above;
  using config::at_least;
  binder.text("recording", s.recording, "folder of a recorded walk to play in the board's place");
  binder.flag("simulation.enabled", s.simulate, "play a simulated walk in the board's place");
  binder.integer("simulation.seed", s.simulation_seed, at_least(0), "", "seed of the walk");
  binder.number("simulation.duration_s", s.simulation_duration_s, above(0), "s", "its length");
  binder.number("playback.rate", s.playback_rate, at_least(0), "",
                "speed of playback; 1 is real time, 0 as fast as nothing is lost");
  binder.number("playback.window_s", s.playback_window_s, above(0), "s",
                "how far the slowest awaited service may lag, in sensor time");
  binder.text("calibration", s.calibration,
              "file of the board's calibration, written by vpdr calibrate; empty: none");
  binder.number("expected_rate_hz", s.expected_rate_hz, at_least(0), "Hz",
                "inertial samples that the board should send each second; 0: any number");
  binder.text(
      "mount.axes", s.mount,
      "sensor axes that point forward, left and up on the body, as +y,-x,+z for a phone held "
      "flat; empty: what the calibration or the recording says");
  binder.text("serial.device", s.serial_device, "serial port of the board");
  binder.integer("serial.baud", s.serial_baud, above(0), "bit/s", "its speed");
  bind_protocol(binder, s);
  binder.text("serial.accelerometer_axes", s.accelerometer_axes,
              "board axes and signs of the accelerometer");
  binder.text("serial.gyroscope_axes", s.gyroscope_axes, "board axes and signs of the gyroscope");
  binder.text("serial.magnetometer_axes", s.magnetometer_axes,
              "board axes and signs of the magnetometer");
  binder.text("ros.imu", s.ros_imu,
              "topic of a ROS 2 driver's sensor_msgs/Imu to read instead of a port, as /imu/data");
  binder.text("ros.mag", s.ros_mag, "topic of its sensor_msgs/MagneticField; empty: none");
  binder.text("ros.pressure", s.ros_pressure,
              "topic of its sensor_msgs/FluidPressure; empty: none");
  binder.text("ros.temperature", s.ros_temperature,
              "topic of its sensor_msgs/Temperature; empty: none");
  binder.flag("ros.restamp", s.ros_restamp,
              "map the driver's stamps to this host's clock; false: keep them as they are");
}

}  // namespace vpdr::imu_gateway
