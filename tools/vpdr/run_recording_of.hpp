#pragma once
// The recording that a run was made from.
#include <filesystem>
#include <optional>

#include "dataset/recording.hpp"
#include "evaluation/run_directory.hpp"

namespace vpdr::tool {

/// Reads `given`, or else the recording that the run remembers (run.json). Throws FileFault naming
/// the remedy where there is neither.
dataset::Recording recording_of(const evaluation::RunDirectory& run,
                                const std::optional<std::filesystem::path>& given);

}  // namespace vpdr::tool
