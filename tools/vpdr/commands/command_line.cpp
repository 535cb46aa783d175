#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "config/nearest_name.hpp"
#include "core/errors.hpp"
#include "vpdr/commands/commands.hpp"

namespace vpdr::tool {
namespace {

/// The option that `name` begins, or nearly is.
std::string nearest_option(const std::string& name, const std::vector<std::string>& options) {
  for (const std::string& option : options) {
    if (option.starts_with(name)) return option;
  }
  return config::nearest_name(name, options);
}

/// Words that no command knows, in the order in which they were typed, each option with the nearest
/// one that there is.
int refuse_extras(const CLI::App& app) {
  const CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  std::vector<std::string> options;
  for (const CLI::Option* option : command->get_options()) {
    for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  }
  for (const std::string& word : app.remaining(true)) {
    const std::string name = word.substr(0, word.find('='));
    std::string hint;
    if (name.starts_with("--")) hint = nearest_option(name, options);
    std::cerr << "vpdr: " << command->get_name() << " does not know " << word
              << (hint.empty() ? "" : "; did you mean " + hint + "?") << "\n";
  }
  std::cerr << "Run with --help for more information.\n";
  return static_cast<int>(ExitCode::kUsage);
}

}  // namespace

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
  } catch (const CLI::ExtrasError& error) {
    return refuse_extras(app);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::kUsage);
  }
  return static_cast<int>(ExitCode::kOk);
}

}  // namespace vpdr::tool
