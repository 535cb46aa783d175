#pragma once
// The configuration of every core that `vpdr run` runs, from the same files and keys as the
// services': defaults, then DIR/<service>.yaml, then key=value of the command line.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/run_info.hpp"
#include "vision/app/source_settings.hpp"
#include "vpdr/pipeline.hpp"

namespace vpdr::tool {

struct Configuration {
  PipelineConfig cores;
  vision::SourceSettings frames;  ///< its calibration and video offset hold here too
  std::vector<evaluation::ServiceInfo> services;  ///< each with its configuration in full
};

/// Throws ConfigurationFault naming file, line and key; an assignment's key begins with its
/// service: `pdr.step.min_interval_s=0.3`.
Configuration read_configuration(const std::optional<std::filesystem::path>& folder,
                                 const std::vector<std::string>& assignments);

}  // namespace vpdr::tool
