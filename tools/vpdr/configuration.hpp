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

/// Throws ConfigurationFault where `folder` is none, where it holds no service's file, and where a
/// file's name is nearly a service's and would not be read.
void check_config_folder(const std::filesystem::path& folder);

/// Throws ConfigurationFault where what stands before the first point of SERVICE.KEY=VALUE is none
/// of `services`.
void check_service_of(const std::string& assignment, const std::vector<std::string>& services);

/// Throws ConfigurationFault naming file, line and key; an assignment's key begins with its
/// service: `pdr.step.min_interval_s=0.3`.
Configuration read_configuration(const std::optional<std::filesystem::path>& folder,
                                 const std::vector<std::string>& assignments);

}  // namespace vpdr::tool
