// How far off the fused position is, walk by walk, with one set of parameters:
//   bench_walk_accuracy [--recorded DIR] [--seeds N] [--first-seed N] [--duration S] [--blind]
//                       [--config-dir DIR] [--set SERVICE.KEY=VALUE]
// Recorded walks (DIR, default $VPDR_DATA or ../shared/data, then walks/ilc20): error at surveyed
// waypoints, NEES and share of them in the 95 % ellipse. Simulated walks (seeds 1 to N, rendered
// camera unless --blind): error of the position moved to the true start, and the share of time in
// which the truth lies in the 95 % ellipse.
#include <CLI/CLI.hpp>
#include <Eigen/LU>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "bench/waypoint_fit.hpp"
#include "evaluation/evaluation.hpp"
#include "simulation/walk.hpp"
#include "vision/source/simulated_source.hpp"
#include "vpdr/configuration.hpp"
#include "vpdr/pipeline.hpp"

namespace {

namespace fs = std::filesystem;
using namespace vpdr;        // NOLINT: a program, not a header
using namespace vpdr::tool;  // NOLINT

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec) * 1e-9;
}

/// Keeps what evaluation needs of a run.
struct Kept : PipelineOutput {
  void take_fused(const FusedPose& fused) override {
    const PoseEstimate& p = fused.pose;
    run.fused.push_back({p.stamp_ns, p.position_m, p.world_from_body});
    run.covariance.push_back({p.stamp_ns, p.covariance.topLeftCorner<2, 2>(), p.covariance(5, 5)});
  }
  evaluation::RunDirectory run;
};

/// Mean and worst of a column.
struct Column {
  void add(double value) {
    sum += value;
    worst = std::max(worst, value);
    ++count;
  }
  [[nodiscard]] double mean() const { return sum / std::max(count, 1); }
  double sum = 0.0;
  double worst = 0.0;
  int count = 0;
};

void recorded_walks(const fs::path& folder, const PipelineConfig& config) {
  if (!fs::is_directory(folder)) {
    std::printf("recorded walks: skipped: no data in %s\n\n", folder.c_str());
    return;
  }
  std::vector<fs::path> walks;
  for (const auto& entry : fs::directory_iterator(folder)) walks.push_back(entry.path());
  std::sort(walks.begin(), walks.end());
  std::printf("%-38s %8s %8s %8s %8s %8s %8s %9s\n", "recorded walk", "path m", "mean m", "final m",
              "final %", "NEES", "inside", "x real t.");
  Column mean, final_m, final_percent, nees, inside;
  double walked_s = 0.0;
  double cpu_s = 0.0;
  for (const fs::path& walk : walks) {
    dataset::Recording recording = dataset::read_recording(walk, {.images = false});
    dataset::apply_mount(recording);
    Kept kept;
    Pipeline pipeline(told_by(recording, config), std::nullopt, kept);
    const double begin = cpu_seconds();
    play(recording, pipeline, [](double) {});
    const double taken = cpu_seconds() - begin;
    const double duration =
        to_seconds(recording.imu.back().stamp_ns - recording.imu.front().stamp_ns);
    walked_s += duration;
    cpu_s += taken;
    const auto errors = evaluation::waypoint_errors(kept.run.fused, recording.truth.waypoints);
    if (!errors) continue;
    mean.add(errors->mean_m);
    final_m.add(errors->final_m);
    final_percent.add(errors->final_percent);
    const bench::Honesty honesty = bench::honesty_of(kept.run, recording.truth.waypoints);
    nees.add(honesty.nees);
    inside.add(honesty.inside_percent);
    std::printf("%-38s %8.1f %8.2f %8.2f %8.2f %8.2f %8.1f %9.0f\n", recording.name.c_str(),
                errors->path_m, errors->mean_m, errors->final_m, errors->final_percent,
                honesty.nees, honesty.inside_percent, duration / taken);
  }
  std::printf("mean of %d walks %39.2f %8.2f %8.2f %8.2f %8.1f %9.0f\n\n", mean.count, mean.mean(),
              final_m.mean(), final_percent.mean(), nees.mean(), inside.mean(), walked_s / cpu_s);
}

/// The walk as a recording, with its truth at 20 Hz.
dataset::Recording as_recording(const simulation::SimulatedWalk& walk) {
  dataset::Recording recording;
  recording.imu = walk.imu;
  recording.mag = walk.mag;
  const TimestampNs end = walk.imu.back().stamp_ns;
  for (TimestampNs t = walk.imu.front().stamp_ns; t <= end; t += to_ns(0.05)) {
    const simulation::MotionState state = walk.state_at(t);
    recording.truth.poses.push_back({t, state.position_m, state.world_from_body});
  }
  return recording;
}

struct SimulatedChoices {
  int seeds = 5;
  std::uint64_t first_seed = 1;
  double duration_s = 120.0;
  bool blind = false;
  bool draw_walker = false;
};

void simulated_walks(const SimulatedChoices& choices, const PipelineConfig& config) {
  std::printf("%-16s %8s %8s %8s %8s %8s %8s %8s\n", "simulated walk", "path m", "mean m", "mean %",
              "final m", "final %", "max m", "inside");
  Column mean, mean_percent, final_m, final_percent, inside;
  for (int i = 0; i < choices.seeds; ++i) {
    simulation::WalkOptions options;
    options.seed = choices.first_seed + static_cast<std::uint64_t>(i);
    options.duration_s = choices.duration_s;
    options.draw_walker = choices.draw_walker;
    const dataset::Recording recording = as_recording(simulation::simulate_walk(options));
    std::optional<PipelineFrames> frames;
    if (!choices.blind) {
      frames.emplace(PipelineFrames{vision::make_camera(options.camera),
                                    vision::make_simulated_source(options)});
    }
    Kept kept;
    PipelineConfig worn = config;
    worn.pdr.carry = pdr::carry_named(simulation::name_of(options.worn));
    Pipeline pipeline(worn, std::move(frames), kept);
    play(recording, pipeline, [](double) {});
    const auto errors = evaluation::position_errors(kept.run, recording.truth);
    if (!errors) continue;
    const auto& start = errors->start_aligned;
    mean.add(start.mean_m);
    mean_percent.add(100.0 * start.mean_m / errors->path_m);
    final_m.add(start.final_m);
    final_percent.add(start.final_percent);
    inside.add(errors->inside_95_percent.value_or(0.0));
    std::printf("seed %-11llu %8.1f %8.2f %8.2f %8.2f %8.2f %8.2f %8.1f\n",
                static_cast<unsigned long long>(options.seed), errors->path_m, start.mean_m,
                100.0 * start.mean_m / errors->path_m, start.final_m, start.final_percent,
                start.max_m, errors->inside_95_percent.value_or(0.0));
    std::fflush(stdout);
  }
  std::printf("mean of %-8d %17.2f %8.2f %8.2f %8.2f %17.1f\n", mean.count, mean.mean(),
              mean_percent.mean(), final_m.mean(), final_percent.mean(), inside.mean());
}

fs::path default_walks() {
  const char* data = std::getenv("VPDR_DATA");
  return (data != nullptr ? fs::path(data) : fs::path("../shared/data")) / "walks/ilc20";
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Position errors of recorded and simulated walks.");
  fs::path recorded = default_walks();
  SimulatedChoices simulated;
  std::optional<fs::path> config_dir;
  std::vector<std::string> sets;
  app.add_option("--recorded", recorded, "folder of recordings with waypoints");
  app.add_option("--seeds", simulated.seeds, "how many simulated walks")->capture_default_str();
  app.add_option("--first-seed", simulated.first_seed, "")->capture_default_str();
  app.add_option("--duration", simulated.duration_s, "of a simulated walk, s")
      ->capture_default_str();
  app.add_flag("--blind", simulated.blind, "no camera in the simulated walks; much quicker");
  app.add_flag("--draw-walker", simulated.draw_walker, "a random adult in each simulated walk");
  app.add_option("--config-dir", config_dir, "folder with pdr.yaml, vision.yaml, fusion.yaml");
  app.add_option("--set", sets, "SERVICE.KEY=VALUE over the files");
  CLI11_PARSE(app, argc, argv);
  try {
    const Configuration configuration = read_configuration(config_dir, sets);
    recorded_walks(recorded, configuration.cores);
    simulated_walks(simulated, configuration.cores);
  } catch (const Fault& fault) {
    std::fprintf(stderr, "bench_walk_accuracy: %s\n", fault.what());
    return static_cast<int>(fault.code());
  }
  return 0;
}
