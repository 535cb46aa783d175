#include <CLI/CLI.hpp>

#include "core/errors.hpp"
#include "vpdr/commands/commands.hpp"

namespace vpdr::tool {

int run_command_line(int argc, char** argv) {
  CLI::App app(
      "vpdr locates a walking person indoors: inertial and magnetic sensors, and a camera.\n"
      "Recordings are folders as docs/recordings.md describes them.",
      "vpdr");
  app.require_subcommand(1);
  app.footer("vpdr COMMAND --help tells a command's options. Exit codes: docs/operations.md.");
  add_run(app);
  add_up(app);
  add_simulate(app);
  add_evaluate(app);
  add_report(app);
  add_listen(app);
  add_vanishing_points(app);
  add_calibrate(app);
  add_monitor(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  return static_cast<int>(ExitCode::kOk);
}

}  // namespace vpdr::tool
