#include "vpdr/network.hpp"

#include <CLI/CLI.hpp>

#include "app/settings.hpp"
#include "core/errors.hpp"

namespace vpdr::tool {

void add_network_options(CLI::App& command, NetworkOptions& options) {
  command.add_option("--walker", options.walker, "name of the walker (VPDR_WALKER)");
  command.add_option("--domain", options.domain, "DDS domain (VPDR_DOMAIN)");
}

dds::ParticipantOptions participant_options(const NetworkOptions& options,
                                            const std::string& service) {
  app::CommonSettings common;
  config::Binder binder("vpdr");
  app::bind(binder, common);
  app::apply_environment(binder);
  const auto assign = [&binder](const std::string& option, const std::string& assignment) {
    try {
      binder.assign(assignment);
    } catch (const ConfigurationFault& fault) {
      const std::string what = fault.what();
      throw ConfigurationFault(option + what.substr(what.rfind(": ")));
    }
  };
  if (options.walker) assign("--walker " + *options.walker, "service.walker=" + *options.walker);
  if (options.domain) assign("--domain " + *options.domain, "service.domain=" + *options.domain);
  dds::ParticipantOptions out;
  out.walker = common.walker;
  out.domain = common.domain;
  out.interfaces = common.interfaces;
  out.peers = common.peers;
  out.service = service;
  return out;
}

}  // namespace vpdr::tool
