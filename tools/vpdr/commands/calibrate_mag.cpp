// vpdr calibrate mag: the magnetometer, from turning the board every way.
#include <CLI/CLI.hpp>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>

#include "calibration/sphere_coverage.hpp"
#include "core/axis_map.hpp"
#include "core/rotation.hpp"
#include "vpdr/commands/calibration_options.hpp"
#include "vpdr/commands/commands.hpp"

namespace vpdr::tool {
namespace {

constexpr double kEnoughCoverage = 0.85;

struct MagOptions {
  CalibrationCommand command;
  bool southern = false;
};

std::string progress(const SensorStreams& streams, const calibration::BoardCalibration&) {
  std::vector<calibration::LengthSample> samples;
  for (const TimedVector& m : streams.field_ut) samples.push_back({m.value, 1.0});
  const calibration::Sphere sphere = calibration::fit_sphere(samples);
  calibration::SphereCoverage coverage;
  for (const auto& s : samples) coverage.add(s.value - sphere.centre);
  std::ostringstream text;
  text << "directions seen " << std::fixed << std::setprecision(0) << 100.0 * coverage.share()
       << " %, turn on until the field points along "
       << calibration::direction_name(coverage.largest_hole());
  return text.str();
}

void print(const calibration::MagnetometerSection& m) {
  std::cout << std::fixed << std::setprecision(0) << "magnetometer: " << 100.0 * m.coverage
            << " % of all directions, " << std::setprecision(2) << "length of the field off by "
            << 100.0 * m.residual_before << " % before, " << 100.0 * m.residual << " % after, axes "
            << axis_map_name(m.axes) << "\n"
            << std::setprecision(1) << "field: " << m.field_ut << " uT, " << to_degrees(m.dip_rad)
            << " deg below the horizon\n";
}

}  // namespace

void add_calibrate_mag(CLI::App& calibrate) {
  auto options = std::make_shared<MagOptions>();
  CLI::App* command = calibrate.add_subcommand(
      "mag", "Magnetometer: turn the board slowly every way, away from iron. After imu.");
  add_calibration_options(*command, options->command);
  command->add_flag("--southern", options->southern,
                    "the southern hemisphere, where the field points up");
  command->callback([options] {
    const CalibrationKind kind{
        calibration::calibrate_mag,
        "Hold the board as it is worn, with all that is mounted on it, away from iron; turn it "
        "slowly every way: a somersault about each axis, then a ball of wool.",
        progress, [](const calibration::Calibrated& found) {
          return found.board.magnetometer.coverage >= kEnoughCoverage;
        }};
    calibration::CalibrationOptions how;
    how.southern = options->southern;
    print(calibrate_and_report(kind, options->command, how).board.magnetometer);
  });
}

}  // namespace vpdr::tool
