#pragma once
// The command line of the calibrations of a board.
#include <string>

#include "vpdr/board/calibration_session.hpp"
#include "vpdr/network.hpp"

namespace vpdr::tool {

struct CalibrationCommand {
  CalibrationChoices choices;
  NetworkOptions network;
};

/// Sources, file, names, duration and network.
void add_calibration_options(CLI::App& command, CalibrationCommand& options);

/// Runs the calibration and prints its notes and where it is kept.
calibration::Calibrated calibrate_and_report(const CalibrationKind& kind,
                                             const CalibrationCommand& command,
                                             const calibration::CalibrationOptions& options);

}  // namespace vpdr::tool
