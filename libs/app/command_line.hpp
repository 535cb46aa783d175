#pragma once
// Command line of every service, on top of its YAML file and the environment.
#include <optional>

#include "app/service.hpp"

namespace vpdr::app {

struct CommandLineOutcome {
  std::optional<int> exit;  ///< leave now with this code: --help, --print-config, usage error
};

/// Fills `common` and the service's own settings. Later wins: defaults, file, environment, --set,
/// flags. Throws ConfigurationFault.
CommandLineOutcome read_command_line(const ServiceEntry& entry, CommonSettings& common, int argc,
                                     char** argv);

}  // namespace vpdr::app
