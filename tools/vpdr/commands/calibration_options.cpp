#include "vpdr/commands/calibration_options.hpp"

#include <CLI/CLI.hpp>
#include <iostream>

namespace vpdr::tool {

void add_calibration_options(CLI::App& command, CalibrationCommand& options) {
  CalibrationChoices& choices = options.choices;
  command.add_option("SOURCE", choices.sources,
                     "recording, logs of the board, or folders of logs; none: the board of the "
                     "imu_gateway that runs now");
  command.add_option("--recording", choices.sources, "the same");
  command
      .add_option("--out", choices.out,
                  "file of the board; what other calibrations wrote there stays")
      ->capture_default_str();
  command.add_option("--board", choices.board, "kind of board, to be written into the file");
  command.add_option("--serial-number", choices.serial, "number of this board, the same");
  command.add_option("--duration", choices.duration_s, "live: no longer than this, s")
      ->capture_default_str();
  add_network_options(command, options.network);
}

calibration::Calibrated calibrate_and_report(const CalibrationKind& kind,
                                             const CalibrationCommand& command,
                                             const calibration::CalibrationOptions& options) {
  calibration::Calibrated found = run_calibration(kind, command.choices, options, [&command] {
    return participant_options(command.network, "vpdr_calibrate");
  });
  for (const std::string& note : found.notes) std::cout << "note: " << note << "\n";
  std::cout << "written to " << command.choices.out.string()
            << "; imu_gateway --calibration loads it\n";
  return found;
}

}  // namespace vpdr::tool
