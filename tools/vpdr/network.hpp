#pragma once
// The command's own presence on a walker's network.
#include <optional>
#include <string>

#include "dds/participant.hpp"

namespace CLI {
class App;
}

namespace vpdr::tool {

/// As given on the command line; nothing: environment, then the default.
struct NetworkOptions {
  std::optional<std::string> walker;
  std::optional<std::string> domain;
};

void add_network_options(CLI::App& command, NetworkOptions& options);

/// The services' settings (VPDR_WALKER, VPDR_DOMAIN, VPDR_INTERFACES, VPDR_PEERS) with the options
/// over them, under the participant name `service`. Throws ConfigurationFault.
dds::ParticipantOptions participant_options(const NetworkOptions& options,
                                            const std::string& service);

}  // namespace vpdr::tool
