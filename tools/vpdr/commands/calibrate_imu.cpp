// vpdr calibrate imu: accelerometer and gyroscope, from laying the board down on its sides.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>

#include "core/axis_map.hpp"
#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "vpdr/commands/calibration_options.hpp"
#include "vpdr/commands/commands.hpp"

namespace vpdr::tool {
namespace {

struct ImuOptions {
  CalibrationCommand command;
  std::string up;
};

/// Unit vector of "+z".
Eigen::Vector3d axis_of(const std::string& name) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const char sign : {'+', '-'}) {
      if (name == std::string{sign, "xyz"[axis]}) {
        return (sign == '-' ? -1.0 : 1.0) * Eigen::Vector3d::Unit(axis);
      }
    }
  }
  throw ConfigurationFault("--up " + name + ": is no axis; write one of +x -x +y -y +z -z");
}

std::string progress(const SensorStreams& streams, const calibration::BoardCalibration&) {
  const auto rests = calibration::find_rests(streams);
  const auto numbers = calibration::number_poses(rests);
  const std::size_t poses =
      numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end()) + 1;
  double longest = 0.0;
  for (const auto& rest : rests) longest = std::max(longest, rest.duration_s());
  std::ostringstream text;
  text << "poses " << poses << " of 6 or more, longest rest " << std::fixed << std::setprecision(0)
       << longest << " s";
  return text.str();
}

void print(const calibration::BoardCalibration& board) {
  const auto& a = board.accelerometer;
  std::cout << std::fixed << std::setprecision(2) << "accelerometer: " << a.poses
            << " poses, length of gravity at rest off by " << 100.0 * a.residual_before
            << " % before, " << std::setprecision(3) << 100.0 * a.residual << " % after, axes "
            << axis_map_name(a.axes) << "\n";
  const auto& g = board.gyroscope;
  if (g.date.empty()) return;
  std::cout << "gyroscope: bias " << to_degrees(g.correction.bias.norm()) << " deg/s, wander "
            << to_degrees(g.residual) << " deg/s, axes " << axis_map_name(g.axes) << "\n";
  if (g.noise_density.isZero()) return;
  std::cout << "noise: " << to_degrees(g.noise_density.maxCoeff())
            << " deg/s/sqrt(Hz), bias instability " << to_degrees(g.bias_instability.maxCoeff())
            << " deg/s\n";
}

}  // namespace

void add_calibrate_imu(CLI::App& calibrate) {
  auto options = std::make_shared<ImuOptions>();
  CLI::App* command = calibrate.add_subcommand(
      "imu", "Accelerometer and gyroscope: lay the board down on each of its six sides.");
  add_calibration_options(*command, options->command);
  command->add_option("--up", options->up,
                      "sensor axis that points up in the first rest, as +z: finds the sign of an "
                      "accelerometer that reads gravity instead of the force against it");
  command->callback([options] {
    const CalibrationKind kind{
        calibration::calibrate_imu,
        "Lay the board down for two seconds on each of its six sides, turning it slowly in "
        "between; then leave it alone for a minute.",
        progress, [](const calibration::Calibrated& found) {
          return found.board.accelerometer.poses >= 6 &&
                 !found.board.gyroscope.noise_density.isZero();
        }};
    calibration::CalibrationOptions how;
    if (!options->up.empty()) how.first_up = axis_of(options->up);
    print(calibrate_and_report(kind, options->command, how).board);
  });
}

}  // namespace vpdr::tool
