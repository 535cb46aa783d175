#pragma once
// One run of the cores over a recording, with its folder of results.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "evaluation/run_directory.hpp"
#include "vpdr/configuration.hpp"

namespace vpdr::tool {

struct RunChoices {
  bool vision = true;  ///< false: images are left alone
};

/// What people are told of a run.
struct RunReport {
  evaluation::Summary summary;
  std::vector<std::string> warnings;  ///< what was refused or done without, a line each
  std::string text;                   ///< a few lines: steps, distance, speed, where it ended
};

/// Reads the recording, runs it, writes DIR. Throws FileFault and ConfigurationFault.
RunReport run_recording(const std::filesystem::path& recording, const std::filesystem::path& out,
                        const Configuration& configuration, const RunChoices& choices,
                        const std::function<void(double)>& progress);

}  // namespace vpdr::tool
