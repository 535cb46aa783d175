#include "imu_gateway/app/make_source.hpp"

#include "core/axis_map.hpp"
#include "core/errors.hpp"
#include "core/host_clock.hpp"
#include "dataset/recording.hpp"
#include "imu_gateway/app/ros_source.hpp"
#include "imu_gateway/source/serial_source.hpp"
#include "imu_gateway/source/timeline_source.hpp"
#include "simulation/walk.hpp"

namespace vpdr::imu_gateway {
namespace {

Eigen::Matrix3d axes(const std::string& key, const std::string& names, bool allow_mirror) {
  const auto map = parse_axis_map(names, allow_mirror);
  if (!map) throw ConfigurationFault("imu_gateway." + key + ": " + map.error().message);
  return map.value();
}

OpenedSource open_recording(const GatewaySettings& settings) {
  dataset::ReadOptions samples_only;
  samples_only.images = false;
  samples_only.truth = false;
  const auto recording = dataset::read_recording(settings.recording, samples_only);
  const Eigen::Matrix3d mount =
      settings.mount.empty() ? recording.about.mount : axes("mount.axes", settings.mount, false);
  OpenedSource opened;
  opened.source = std::make_unique<TimelineSource>(
      merge_by_stamp(recording.imu, recording.mag, recording.pressure), mount);
  opened.body_from_board = mount;
  opened.has_magnetometer = !recording.mag.empty();
  opened.has_pressure = !recording.pressure.empty();
  opened.is_playback = true;
  opened.refused_rows = recording.report.refused();
  return opened;
}

OpenedSource open_simulation(const GatewaySettings& settings) {
  simulation::WalkOptions options;
  options.seed = settings.simulation_seed;
  options.duration_s = settings.simulation_duration_s;
  const auto walk = simulation::simulate_walk(options);
  OpenedSource opened;
  opened.source = std::make_unique<TimelineSource>(
      merge_by_stamp(walk.imu, walk.mag, walk.pressure), Eigen::Matrix3d::Identity());
  opened.has_magnetometer = !walk.mag.empty();
  opened.has_pressure = !walk.pressure.empty();
  opened.is_playback = true;
  return opened;
}

ParserOptions parser_options(const GatewaySettings& settings) {
  ParserOptions options;
  options.protocol = settings.serial_protocol;
  options.lines.separator = settings.serial_separator;
  for (const std::string& columns : settings.serial_lines) {
    const auto layout = LineLayout::parse(columns, settings.serial_separator);
    if (!layout) throw ConfigurationFault("imu_gateway.serial.lines: " + layout.error().message);
    options.lines.layouts.push_back(layout.value());
  }
  options.wit_acceleration_range_g = settings.wit_acceleration_range_g;
  options.wit_rate_range_dps = settings.wit_rate_range_dps;
  options.field_unit_ut = settings.serial_field_unit_ut;
  return options;
}

OpenedSource open_serial(const GatewaySettings& settings) {
  SerialOptions options;
  options.device = settings.serial_device;
  options.baud = settings.serial_baud;
  options.parser = parser_options(settings);
  options.axes.accelerometer = axes("serial.accelerometer_axes", settings.accelerometer_axes, true);
  options.axes.gyroscope = axes("serial.gyroscope_axes", settings.gyroscope_axes, true);
  options.axes.magnetometer = axes("serial.magnetometer_axes", settings.magnetometer_axes, true);
  if (!settings.mount.empty()) options.axes.mount = axes("mount.axes", settings.mount, false);
  options.host_clock = host_now_ns;
  OpenedSource opened;
  opened.body_from_board = options.axes.mount;
  opened.source = std::make_unique<SerialSource>(std::move(options));
  opened.name = "serial";
  // What a board has shows only when it sends; its topics are there from the start.
  opened.has_magnetometer = true;
  opened.has_pressure = true;
  opened.has_temperature = true;
  return opened;
}

OpenedSource open_ros(const GatewaySettings& settings, dds::Participant& participant) {
  const std::string own = "/" + participant.options().walker + "/";
  for (const std::string& topic :
       {settings.ros_imu, settings.ros_mag, settings.ros_pressure, settings.ros_temperature}) {
    if (topic.starts_with(own + "imu/")) {
      throw ConfigurationFault("imu_gateway.ros: " + topic +
                               " is written by imu_gateway itself; name the driver's topic");
    }
  }
  RosOptions options;
  options.imu_topic = settings.ros_imu;
  options.magnetometer_topic = settings.ros_mag;
  options.pressure_topic = settings.ros_pressure;
  options.temperature_topic = settings.ros_temperature;
  options.restamp = settings.ros_restamp;
  if (!settings.mount.empty()) options.axes.mount = axes("mount.axes", settings.mount, false);
  options.host_clock = host_now_ns;
  OpenedSource opened;
  opened.body_from_board = options.axes.mount;
  opened.name = "ros";
  opened.has_magnetometer = !settings.ros_mag.empty();
  opened.has_pressure = !settings.ros_pressure.empty();
  opened.has_temperature = !settings.ros_temperature.empty();
  opened.source = std::make_unique<RosSource>(participant, std::move(options));
  return opened;
}

}  // namespace

OpenedSource open_source(const GatewaySettings& settings, dds::Participant& participant) {
  const int chosen = (settings.recording.empty() ? 0 : 1) + (settings.simulate ? 1 : 0) +
                     (settings.serial_device.empty() ? 0 : 1) + (settings.ros_imu.empty() ? 0 : 1);
  if (chosen != 1) {
    throw ConfigurationFault(
        "imu_gateway: " + std::string(chosen == 0 ? "no" : "more than one") +
        " source is chosen; give exactly one of --recording DIR, --simulate, --serial DEV, "
        "--ros TOPIC");
  }
  if (!settings.recording.empty()) return open_recording(settings);
  if (settings.simulate) return open_simulation(settings);
  if (!settings.ros_imu.empty()) return open_ros(settings, participant);
  return open_serial(settings);
}

}  // namespace vpdr::imu_gateway
