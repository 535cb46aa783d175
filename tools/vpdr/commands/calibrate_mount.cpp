// vpdr calibrate mount: which way the board sits on the person.
#include <CLI/CLI.hpp>
#include <iomanip>
#include <iostream>
#include <memory>

#include "core/axis_map.hpp"
#include "vpdr/commands/calibration_options.hpp"
#include "vpdr/commands/commands.hpp"

namespace vpdr::tool {
namespace {

constexpr double kEnoughWalkingS = 12.0;

std::string progress(const SensorStreams& streams, const calibration::BoardCalibration& known) {
  const auto mount = calibration::estimate_mount(calibration::corrected(streams, known));
  return mount ? "walked " + std::to_string(static_cast<int>(mount.value().walking_s)) + " s of " +
                     std::to_string(static_cast<int>(kEnoughWalkingS))
               : mount.error().message;
}

void print(const calibration::MountSection& mount) {
  std::cout << "mount: forward, left and up are board " << std::fixed << std::setprecision(3);
  for (int row = 0; row < 3; ++row) {
    std::cout << (row > 0 ? ", " : "") << "(" << mount.body_from_board.row(row) << ")";
  }
  std::cout << ", nearest to mount.axes " << axis_map_name(nearest_axis_map(mount.body_from_board))
            << "\nfrom " << std::setprecision(0) << mount.walking_s << " s of walking, "
            << 100.0 * mount.straightness << " % of the push along forward\n";
}

}  // namespace

void add_calibrate_mount(CLI::App& calibrate) {
  auto options = std::make_shared<CalibrationCommand>();
  CLI::App* command = calibrate.add_subcommand(
      "mount", "How the board is worn: stand still, then walk straight on. After imu.");
  add_calibration_options(*command, *options);
  command->callback([options] {
    const CalibrationKind kind{
        calibration::calibrate_mount,
        "Wear the board as you will, tight on the trunk or the head; stand still for three "
        "seconds, then walk straight on for ten steps or more.",
        progress, [](const calibration::Calibrated& found) {
          return found.board.mount.walking_s >= kEnoughWalkingS;
        }};
    print(calibrate_and_report(kind, *options, {}).board.mount);
  });
}

}  // namespace vpdr::tool
