// vpdr evaluate: the errors of a run against the truth of its recording.
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "evaluation/evaluation.hpp"
#include "vpdr/commands/commands.hpp"
#include "vpdr/run_recording_of.hpp"

namespace vpdr::tool {
namespace {

struct EvaluateOptions {
  std::filesystem::path run;
  std::optional<std::filesystem::path> recording;
  bool json = false;
};

void evaluate(const EvaluateOptions& options) {
  const auto run = evaluation::RunDirectory::read(options.run);
  const auto recording = recording_of(run, options.recording);
  const evaluation::Evaluation result = evaluation::evaluate(run, recording);
  std::cout << (options.json ? evaluation::to_json(result) + "\n" : evaluation::to_table(result));
}

}  // namespace

void add_evaluate(CLI::App& app) {
  auto options = std::make_shared<EvaluateOptions>();
  CLI::App* command = app.add_subcommand(
      "evaluate",
      "Errors of a run: attitude, steps, waypoints, position, as far as truth is known.");
  command->add_option("DIR", options->run, "folder that 'vpdr run --out' wrote")->required();
  command->add_option("RECORDING", options->recording,
                      "folder of the recording (default: the one the run remembers)");
  command->add_flag("--json", options->json, "one JSON object instead of a table");
  command->callback([options] { evaluate(*options); });
}

}  // namespace vpdr::tool
