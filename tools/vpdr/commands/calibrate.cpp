// vpdr calibrate: the parent of the calibrations.
#include <CLI/CLI.hpp>

#include "vpdr/commands/commands.hpp"

namespace vpdr::tool {

void add_calibrate(CLI::App& app) {
  CLI::App* calibrate = app.add_subcommand(
      "calibrate", "Calibrates a sensor board or a camera (docs/calibration.md).");
  calibrate->require_subcommand(1);
  add_calibrate_camera(*calibrate);
  add_calibrate_imu(*calibrate);
  add_calibrate_mag(*calibrate);
  add_calibrate_mount(*calibrate);
}

}  // namespace vpdr::tool
