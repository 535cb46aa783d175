#pragma once
// The YAML file in which the calibration of one board is kept. docs/calibration.md describes it.
#include <filesystem>

#include "calibration/board_calibration.hpp"

namespace vpdr::calibration {

/// Reads and checks a file. Throws ConfigurationFault naming every mistake: keys and values as
/// config::Binder does, axes that are none, matrices no sensor has, a mount that is no rotation.
BoardCalibration read_calibration(const std::filesystem::path& file);

/// Writes a file that read_calibration takes back, whole or not at all. Throws FileFault.
void write_calibration(const BoardCalibration& board, const std::filesystem::path& file);

}  // namespace vpdr::calibration
