#pragma once
// Recordings of boards that nobody walked with: tables of seconds, g or m/s^2, degrees or radians
// per second, as their makers left them. Axes are the board's own.
#include <filesystem>
#include <vector>

#include "dataset/recording.hpp"

namespace vpdr::bench {

/// Inertial samples of every board file below `boards` and of BROAD's rotation trials in `broad`.
std::vector<dataset::Recording> boards_nobody_walks_with(const std::filesystem::path& boards,
                                                         const std::filesystem::path& broad);

}  // namespace vpdr::bench
