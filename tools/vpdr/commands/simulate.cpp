// vpdr simulate: a walk that nobody walked, with its truth, as a recording folder.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>

#include "simulation/recording_writer.hpp"
#include "vpdr/commands/commands.hpp"
#include "vpdr/progress_bar.hpp"

namespace vpdr::tool {
namespace {

struct SimulateOptions {
  std::filesystem::path out;
  simulation::WalkOptions walk;
  std::string worn = "head";
  bool no_images = false;
};

void simulate(SimulateOptions options) {
  using simulation::WornAt;
  options.walk.worn = options.worn == "chest"   ? WornAt::kChest
                      : options.worn == "waist" ? WornAt::kWaist
                                                : WornAt::kHead;
  const simulation::SimulatedWalk walk = simulation::simulate_walk(options.walk);
  ProgressBar bar(options.no_images ? "writing" : "rendering");
  simulation::RecordingOptions recording;
  recording.images = !options.no_images;
  simulation::write_recording(walk, options.out, recording,
                              [&bar](double share) { bar.update(share); });
  std::cout << "simulated walk in " << options.out.string() << ": " << options.walk.duration_s
            << " s, " << walk.steps.size() << " steps, seed " << options.walk.seed << "\n";
}

}  // namespace

void add_simulate(CLI::App& app) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* command = app.add_subcommand(
      "simulate",
      "Write a simulated walk through corridors, with truth and camera, as a recording.");
  command->add_option("--out", options->out, "folder of the recording")->required();
  command->add_option("--seed", options->walk.seed, "the same seed gives the same walk")
      ->capture_default_str();
  command->add_option("--duration", options->walk.duration_s, "length, s")
      ->check(CLI::Range(1.0, 7200.0))
      ->capture_default_str();
  command->add_option("--imu-rate", options->walk.imu_rate_hz, "inertial samples a second")
      ->check(CLI::Range(20.0, 2000.0))
      ->capture_default_str();
  command->add_option("--worn", options->worn, "where the board is worn")
      ->check(CLI::IsMember({"head", "chest", "waist"}))
      ->capture_default_str();
  command->add_flag("--draw-walker", options->walk.draw_walker,
                    "a random adult instead of the average one");
  command->add_flag("--no-images", options->no_images, "samples and truth only; much quicker");
  command->callback([options] { simulate(*options); });
}

}  // namespace vpdr::tool
