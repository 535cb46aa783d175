// vpdr report: report.html and trajectory.svg of a run.
#include "evaluation/report.hpp"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "core/errors.hpp"
#include "run_export/run_export.hpp"
#include "vpdr/commands/commands.hpp"
#include "vpdr/run_recording_of.hpp"

namespace vpdr::tool {
namespace {

struct ReportOptions {
  std::filesystem::path run;
  std::optional<std::filesystem::path> recording;
};

void report(const ReportOptions& options) {
  // What the recorder left is turned into a run first; the walk it remembers is kept.
  const auto recorded = options.run / "recording.mcap";
  if (std::filesystem::exists(recorded)) {
    const std::filesystem::path played = options.recording
                                             ? std::filesystem::absolute(*options.recording)
                                             : evaluation::read_run_info(options.run).recording;
    run_export::export_run(recorded, options.run, {.recording = played});
  }
  const auto run = evaluation::RunDirectory::read(options.run);
  if (options.recording || !run.info.recording.empty()) {
    const dataset::Recording recording = recording_of(run, options.recording);
    evaluation::write_report(run, &recording);
  } else {
    evaluation::write_report(run, nullptr);
  }
  std::cout << "report: " << (options.run / "report.html").string() << "\n";
}

}  // namespace

void add_report(CLI::App& app) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand(
      "report", "Write report.html and trajectory.svg of a run, or of its recording.mcap.");
  command->add_option("DIR", options->run, "folder of the run")->required();
  command->add_option("--recording", options->recording,
                      "folder of the walk that was played (default: the one the run remembers)");
  command->callback([options] { report(*options); });
}

}  // namespace vpdr::tool
