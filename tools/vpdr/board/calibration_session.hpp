#pragma once
// What the three calibrations of a board have in common: where the samples come from, what a person
// sees meanwhile, and the file that comes of it.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "calibration/calibrate.hpp"
#include "dds/participant.hpp"

namespace vpdr::tool {

struct CalibrationChoices {
  std::vector<std::filesystem::path> sources;  ///< logs and folders; none: the live board
  std::filesystem::path out = "board.yaml";    ///< sections of other calibrations stay
  std::string board;                           ///< empty: what the file says
  std::string serial;
  double duration_s = 180.0;  ///< of the live board, at most
};

/// One of the calibrations.
struct CalibrationKind {
  std::function<Result<calibration::Calibrated>(const SensorStreams&,
                                                const calibration::BoardCalibration&,
                                                const calibration::CalibrationOptions&)>
      calibrate;
  /// What a person is to do, before it begins.
  std::string instruction;
  /// One line on how far it is, for the terminal.
  std::function<std::string(const SensorStreams&, const calibration::BoardCalibration&)> progress;
  /// Whether more samples of a live board would make what is found no better.
  std::function<bool(const calibration::Calibrated&)> is_enough;
};

/// Reads the sources (or the board of a running gateway), calibrates and writes the file. Returns
/// what was found. Throws Fault with the remedy where the samples will not do; the file is then as
/// it was.
calibration::Calibrated run_calibration(
    const CalibrationKind& kind, const CalibrationChoices& choices,
    calibration::CalibrationOptions options,
    const std::function<dds::ParticipantOptions()>& participant_options);

/// Raw streams of logs, of folders with logs, and of recordings, in sensor axes.
SensorStreams read_sources(const std::vector<std::filesystem::path>& sources);

}  // namespace vpdr::tool
