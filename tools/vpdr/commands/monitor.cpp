// vpdr monitor: the parent of the live views.
#include <CLI/CLI.hpp>

#include "vpdr/commands/commands.hpp"

namespace vpdr::tool {

void add_monitor(CLI::App& app) {
  CLI::App* monitor = app.add_subcommand("monitor", "Shows what runs now, in the terminal.");
  monitor->require_subcommand(1);
  add_monitor_imu(*monitor);
}

}  // namespace vpdr::tool
