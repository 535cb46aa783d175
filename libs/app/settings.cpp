#include "app/settings.hpp"

#include <array>
#include <cstdlib>
#include <sstream>

#include "dds/topics.hpp"

namespace vpdr::app {

void bind(config::Binder& binder, CommonSettings& s) {
  binder.text(
      "service.walker", s.walker, "letters, digits and _, a letter first, at most 100",
      [](const std::string& name) { return dds::is_walker_name(name); },
      "name of the walker, the namespace of the topics");
  binder.integer("service.domain", s.domain, config::between(0, 232), "", "DDS domain");
  binder.text_list("service.interfaces", s.interfaces,
                   "network interfaces to use, by address or name; empty: all");
  binder.text_list("service.peers", s.peers, "hosts to look for where multicast does not reach");
  binder.choice<std::string>(
      "service.log_level", s.log_level,
      {{"debug", "debug"}, {"info", "info"}, {"warn", "warn"}, {"error", "error"}},
      "how much is logged");
  binder.text_list("service.wait_for", s.wait_for,
                   "services that must be there before the walk begins");
  binder.flag("service.until_end", s.until_end, "end when the walk has ended");
}

void apply_environment(config::Binder& binder) {
  struct Variable {
    const char* name;
    const char* key;
    bool is_list;
  };
  static constexpr std::array<Variable, 5> kVariables{
      {{"VPDR_WALKER", "service.walker", false},
       {"VPDR_DOMAIN", "service.domain", false},
       {"VPDR_INTERFACES", "service.interfaces", true},
       {"VPDR_PEERS", "service.peers", true},
       {"VPDR_LOG_LEVEL", "service.log_level", false}}};
  for (const Variable& variable : kVariables) {
    const char* value = std::getenv(variable.name);
    if (value == nullptr || *value == '\0') continue;
    const std::string text = variable.is_list ? "[" + std::string(value) + "]" : value;
    try {
      binder.assign(std::string(variable.key) + "=" + text);
    } catch (const ConfigurationFault& fault) {
      throw ConfigurationFault(std::string("environment ") + variable.name + ": " + fault.what());
    }
  }
}

std::vector<std::string> split_list(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, ',');) {
    if (!part.empty()) parts.push_back(part);
  }
  return parts;
}

}  // namespace vpdr::app
