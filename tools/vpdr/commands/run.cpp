// vpdr run: all cores on a recording, in one process.
#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>

#include "core/errors.hpp"
#include "vpdr/commands/commands.hpp"
#include "vpdr/configuration.hpp"
#include "vpdr/progress_bar.hpp"
#include "vpdr/recorded_run.hpp"

namespace vpdr::tool {
namespace {

struct RunOptions {
  std::filesystem::path recording;
  std::filesystem::path out;
  std::optional<std::filesystem::path> config_dir;
  std::vector<std::string> sets;
  bool no_vision = false;
  bool print_config = false;
};

void run(const RunOptions& options) {
  const Configuration configuration = read_configuration(options.config_dir, options.sets);
  if (options.print_config) {
    for (const auto& service : configuration.services) std::cout << service.config;
    return;
  }
  ProgressBar bar("walking");
  const RunReport report =
      run_recording(options.recording, options.out, configuration, {.vision = !options.no_vision},
                    [&bar](double share) { bar.update(share); });
  for (const std::string& warning : report.warnings) std::cerr << "vpdr run: " << warning << "\n";
  std::cout << report.text;
}

}  // namespace

void add_run(CLI::App& app) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = app.add_subcommand(
      "run", "Run attitude, steps, vision and fusion on a recording, as fast as the machine goes.");
  auto* recording = command->add_option("RECORDING", options->recording, "folder of the recording");
  auto* out = command->add_option("--out", options->out,
                                  "folder for the result; what a run left there is overwritten");
  command->add_option("--config-dir", options->config_dir,
                      "folder with pdr.yaml, vision.yaml, fusion.yaml (each may be absent)");
  command->add_option("--set", options->sets,
                      "SERVICE.KEY=VALUE over the files, as pdr.step.min_interval_s=0.3; "
                      "may stand several times");
  command->add_flag("--no-vision", options->no_vision, "leave the images alone");
  auto* print = command->add_flag("--print-config", options->print_config,
                                  "print every key with its value, and leave");
  command->callback([=] {
    if (print->count() == 0 && (recording->count() == 0 || out->count() == 0)) {
      throw Fault(ExitCode::kUsage, "run: give a RECORDING and --out DIR; see vpdr run --help");
    }
    run(*options);
  });
}

}  // namespace vpdr::tool
