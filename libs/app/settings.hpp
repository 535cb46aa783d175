#pragma once
// Settings that every service has: who walks, on which network, how it starts and ends.
#include <cstdint>
#include <string>
#include <vector>

#include "config/binder.hpp"

namespace vpdr::app {

/// Bound as `<service>.service.*`; the environment and the command line go over the file.
struct CommonSettings {
  std::string walker = "walker";
  std::uint32_t domain = 0;
  std::vector<std::string> interfaces;  ///< addresses or names; empty: all
  std::vector<std::string> peers;       ///< hosts that multicast does not reach
  std::string log_level = "info";
  std::vector<std::string> wait_for;  ///< services that must be there before the walk begins
  bool until_end = false;             ///< end when the walk has ended
};

/// Declares the common keys.
void bind(config::Binder& binder, CommonSettings& settings);

/// VPDR_WALKER, VPDR_DOMAIN, VPDR_INTERFACES, VPDR_PEERS (comma-separated), VPDR_LOG_LEVEL, where
/// set. Throws ConfigurationFault naming the variable.
void apply_environment(config::Binder& binder);

/// "a,b" to its parts; empty parts are dropped.
std::vector<std::string> split_list(const std::string& text);

}  // namespace vpdr::app
