// How well pdr does on real recordings, with its default configuration for everything:
//   bench_pdr_accuracy [DATA] [--set NAME]... [--no-magnetometer] [--detector NAME]
// DATA (default $VPDR_DATA, then ../shared/data) is the folder of recordings, unpacked or not.
//   chest    an office corridor out and back: the two walks should mirror each other
//   ilc20    27 walks through malls, phone in hand: distance from surveyed waypoints; what would be
//            left of it with the walk turned about its start to fit best, and scaled as well
//   oxford   15 walks, every way to carry a phone: steps counted
//   broad    20 trials with optical reference: attitude; nobody walks there
//   phone    10 walks of a phone with optical reference, some beside magnets: attitude, position
//            (after turning and moving the track to fit best, and as it is from the start)
//   nobody   boards that lie or are turned about, BROAD's rotation trials: steps counted an hour
//   waist    7 trials with the instant of every step: steps within the walking bouts, their timing;
//            nobody leaves the floor: largest height found, floors changed
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "bench/still_boards.hpp"
#include "bench/waypoint_fit.hpp"
#include "core/reading.hpp"
#include "core/rotation.hpp"
#include "dataset/recording.hpp"
#include "evaluation/attitude_errors.hpp"
#include "evaluation/interpolation.hpp"
#include "evaluation/step_errors.hpp"
#include "evaluation/trajectory_errors.hpp"
#include "evaluation/waypoint_errors.hpp"
#include "pdr/core/pdr.hpp"

namespace {

namespace fs = std::filesystem;
using namespace vpdr;  // NOLINT: a program, not a header

const double kNone = std::nan("");

struct Options {
  fs::path data;
  std::vector<std::string> sets;
  bool no_magnetometer = false;
  pdr::DetectorKind detector = pdr::DetectorKind::kGait;
  pdr::StepLengthKind step_length = pdr::StepLengthKind::kCombined;
};

/// One walk, run.
struct Result {
  const dataset::Recording& recording;
  evaluation::RunDirectory run;
  double duration_s = 0.0;
  double taken_s = 0.0;
  double highest_m = 0.0;  ///< largest height found, up or down
  double floor_changes = 0.0;
};

/// Length of the walking bouts' steps over their true length, in percent more: all steps but a
/// bout's first, which leads into it; unknown ones as long as the mean.
double distance_error_percent(const Result& result) {
  const auto& truth = result.recording.truth;
  if (!truth.walking_bouts) return kNone;
  double true_m = 0.0;
  double counted_m = 0.0;
  for (const dataset::Interval& bout : *truth.walking_bouts) {
    double known_m = 0.0;
    double known = 0.0;
    double steps = 0.0;
    for (const dataset::TrueStep& step : truth.steps) {
      if (step.stamp_ns <= bout.begin_ns || step.stamp_ns > bout.end_ns) continue;
      steps += 1.0;
      if (!std::isfinite(step.length_m)) continue;
      known_m += step.length_m;
      known += 1.0;
    }
    if (known == 0.0) continue;
    true_m += known_m / known * steps;
    for (const evaluation::RunStep& step : result.run.steps) {
      const bool within = step.stamp_ns > bout.begin_ns + evaluation::kStepMatchNs &&
                          step.stamp_ns <= bout.end_ns + evaluation::kStepMatchNs;
      if (within) counted_m += step.length_m;
    }
  }
  return true_m > 0.0 ? 100.0 * (counted_m / true_m - 1.0) : kNone;
}

/// Length of the steps between the first and the last waypoint over the straight lines between
/// all of them, in percent more.
double scale_percent(const Result& result) {
  const auto& waypoints = result.recording.truth.waypoints;
  double straight_m = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    straight_m += (waypoints[i].position_m - waypoints[i - 1].position_m).norm();
  }
  double walked_m = 0.0;
  for (const evaluation::RunStep& step : result.run.steps) {
    const bool between =
        step.stamp_ns > waypoints.front().stamp_ns && step.stamp_ns <= waypoints.back().stamp_ns;
    if (between) walked_m += step.length_m;
  }
  return 100.0 * (walked_m / straight_m - 1.0);
}

/// Figures of one recording by column; the mean over the set is printed below them.
using Row = std::vector<double>;

using Recordings = std::vector<dataset::Recording>;

struct Set {
  std::function<Recordings(const fs::path& data)> recordings;
  std::vector<std::string> columns;
  std::function<Row(const Result&)> figures;
};

Result run_pdr(const dataset::Recording& recording, const Options& options) {
  pdr::PdrConfig config;
  config.attitude.magnetic.declination_rad = recording.about.declination_rad;
  config.attitude.use_magnetometer = !options.no_magnetometer;
  config.step.detector = options.detector;
  config.person.height_m = recording.about.height_m.value_or(0.0);
  config.step_length.model = options.step_length;
  config.carry = pdr::carry_named(recording.about.carry);
  Result result{recording, {}};
  const auto start = std::chrono::steady_clock::now();
  pdr::Pdr pdr(config);
  pdr::PdrOutput out;
  const auto take = [&](const auto& sample) {
    if constexpr (!std::is_same_v<std::decay_t<decltype(sample)>, ImuSample>) {
      return pdr.process(sample), false;
    } else {
      return pdr.process(sample, out) == Refusal::kNone;
    }
  };
  for (const Reading& reading : merge_by_stamp(recording.imu, recording.mag, recording.pressure)) {
    if (!std::visit(take, reading)) continue;
    const PoseEstimate& pose = *out.odometry;
    result.highest_m = std::max(result.highest_m, std::abs(pose.position_m.z()));
    result.run.fused.push_back({pose.stamp_ns, pose.position_m, pose.world_from_body});
    result.run.covariance.push_back(
        {pose.stamp_ns, pose.covariance.topLeftCorner<2, 2>(), pose.covariance(5, 5)});
    result.run.attitude.push_back({pose.stamp_ns, pose.world_from_body});
    if (out.step && out.step->status == StepStatus::kConfirmed) {
      result.run.steps.push_back({out.step->stamp_ns, out.step->length_m, out.step->yaw_rad});
    }
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  result.taken_s = taken.count();
  result.duration_s = to_seconds(recording.imu.back().stamp_ns - recording.imu.front().stamp_ns);
  result.run.summary.steps = result.run.steps.size();
  result.floor_changes = pdr.height().floors().changes();
  return result;
}

Row waypoint_figures(const Result& result) {
  const auto errors =
      evaluation::waypoint_errors(result.run.fused, result.recording.truth.waypoints);
  if (!errors) return Row(10, kNone);
  const bench::Honesty honesty = bench::honesty_of(result.run, result.recording.truth.waypoints);
  const bench::Fitted fitted =
      bench::fitted_to_waypoints(result.run, result.recording.truth.waypoints);
  return {errors->mean_m,        errors->final_m,
          errors->final_percent, errors->max_m,
          fitted.turned_m,       fitted.scaled_m,
          honesty.nees,          honesty.inside_percent,
          scale_percent(result), result.duration_s / result.taken_s};
}

Row there_and_back_figures(const Result& result) {
  const Eigen::Vector2d end = result.run.fused.back().position_m.head<2>();
  double path_m = 0.0;
  for (const auto& step : result.run.steps) path_m += step.length_m;
  return {static_cast<double>(result.run.steps.size()), path_m, end.norm(),
          to_degrees(std::atan2(end.y(), end.x()))};
}

Row step_figures(const Result& result) {
  const auto errors = evaluation::step_errors(result.run, result.recording);
  if (!errors) return {kNone, kNone, kNone};
  return {static_cast<double>(errors->truth), static_cast<double>(errors->counted),
          errors->error_percent};
}

Row timing_figures(const Result& result) {
  Row row = step_figures(result);
  row.insert(row.end(), {result.highest_m, result.floor_changes});
  const auto errors = evaluation::step_errors(result.run, result.recording);
  if (!errors || !errors->timing) {
    row.insert(row.end(), {kNone, kNone, kNone, kNone, kNone});
    return row;
  }
  const auto& timing = *errors->timing;
  row.insert(row.end(),
             {timing.recall_percent, timing.precision_percent, timing.mean_offset_s,
              timing.length_bias_percent.value_or(kNone), distance_error_percent(result)});
  return row;
}

Row attitude_figures(const Result& result) {
  const auto rmse = evaluation::attitude_rmse(result.run, result.recording);
  const auto steps = static_cast<double>(result.run.steps.size());
  if (!rmse) return {kNone, kNone, kNone, steps};
  return {rmse->total_deg, rmse->heading_deg, rmse->inclination_deg, steps};
}

Row attitude_and_position_figures(const Result& result) {
  Row row = attitude_figures(result);
  const auto errors = evaluation::position_errors(result.run, result.recording.truth);
  if (errors) {
    row.insert(row.end(), {errors->path_m, errors->ate_m, errors->start_aligned.mean_m,
                           errors->inside_95_percent.value_or(kNone)});
  } else {
    row.insert(row.end(), 4, kNone);
  }
  return row;
}

Row hourly_figures(const Result& result) {
  const auto steps = static_cast<double>(result.run.steps.size());
  return {steps, result.duration_s / 60.0, steps / (result.duration_s / 3600.0)};
}

std::vector<fs::path> recordings_in(const fs::path& folder) {
  std::vector<fs::path> found;
  if (!fs::is_directory(folder)) return found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Reads every recording of some folders, turned to body axes.
std::function<Recordings(const fs::path&)> in_folders(std::vector<std::string> folders) {
  return [folders = std::move(folders)](const fs::path& data) {
    Recordings found;
    for (const std::string& folder : folders) {
      for (const fs::path& path : recordings_in(data / folder)) {
        found.push_back(dataset::read_recording(path, {.images = false}));
        dataset::apply_mount(found.back());
      }
    }
    return found;
  };
}

/// Recordings that do not tell how the board is mounted: the axes that point forward and up.
std::function<Recordings(const fs::path&)> mounted(const std::string& folder, std::string forward,
                                                   std::string up) {
  return [=](const fs::path& data) {
    Recordings found = in_folders({folder})(data);
    for (dataset::Recording& recording : found) {
      recording.about.mount = *dataset::mount_from_axes(forward, up);
      dataset::apply_mount(recording);
    }
    return found;
  };
}

Recordings nobody_walks(const fs::path& data) {
  return bench::boards_nobody_walks_with(data / "boards", data / "ahrs/broad");
}

std::map<std::string, Set> all_sets() {
  return {
      {"ilc20",
       {in_folders({"walks/ilc20"}),
        {"mean m", "final m", "final %", "max m", "turned m", "scaled m", "NEES", "inside %",
         "scale %", "x real time"},
        waypoint_figures}},
      {"chest",
       {mounted("walks/chest_xsens", "+z", "+x"),
        {"steps", "path m", "apart m", "towards deg"},
        there_and_back_figures}},
      {"oxford",
       {in_folders({"steps/oxford_validation", "steps/oxford_optimisation"}),
        {"true", "counted", "error %"},
        step_figures}},
      {"broad",
       {in_folders({"ahrs/broad"}),
        {"total deg", "heading", "inclination", "false steps"},
        attitude_figures}},
      {"phone",
       {mounted("walks/phone_mocap", "+y", "+z"),
        {"total deg", "heading", "inclination", "steps", "path m", "fitted m", "mean m",
         "inside %"},
        attitude_and_position_figures}},
      {"nobody", {nobody_walks, {"steps", "minutes", "steps/hour"}, hourly_figures}},
      {"waist",
       {in_folders({"walks/mobilised_waist"}),
        {"true", "counted", "error %", "height m", "floors", "recall %", "precision %", "offset s",
         "length bias %", "distance %"},
        timing_figures}},
  };
}

void print_row(const std::string& name, const Row& row, const std::vector<std::string>& columns) {
  std::printf("  %-46s", name.c_str());
  for (std::size_t i = 0; i < row.size(); ++i) {
    const int width = static_cast<int>(std::max<std::size_t>(9, columns[i].size() + 2));
    if (std::isnan(row[i])) {
      std::printf("%*s", width, "-");
    } else {
      std::printf("%*.2f", width, row[i]);
    }
  }
  std::printf("\n");
}

Row mean_of(const std::vector<Row>& rows, std::size_t columns) {
  Row mean(columns, 0.0);
  for (std::size_t i = 0; i < columns; ++i) {
    double count = 0.0;
    for (const Row& row : rows) {
      if (std::isnan(row[i])) continue;
      mean[i] += row[i];
      count += 1.0;
    }
    mean[i] /= count;
  }
  return mean;
}

bool print_set(const std::string& name, const Set& set, const Options& options) {
  std::printf("%s\n  %-46s", name.c_str(), "");
  for (const std::string& column : set.columns) {
    std::printf("%*s", static_cast<int>(std::max<std::size_t>(9, column.size() + 2)),
                column.c_str());
  }
  std::printf("\n");
  std::vector<Row> rows;
  for (const dataset::Recording& recording : set.recordings(options.data)) {
    rows.push_back(set.figures(run_pdr(recording, options)));
    print_row(recording.name, rows.back(), set.columns);
  }
  if (rows.empty()) {
    std::printf("  skipped: no data\n\n");
    return false;
  }
  Row mean = mean_of(rows, set.columns.size());
  if (set.columns.back() == "steps/hour") mean.back() = 60.0 * mean[0] / mean[1];
  print_row("mean of " + std::to_string(rows.size()), mean, set.columns);
  std::printf("\n");
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const char* const named = std::getenv("VPDR_DATA");
  Options options;
  options.data = named != nullptr ? named : "../shared/data";
  CLI::App app("How well pdr does on real recordings, with its default configuration.");
  app.add_option("DATA", options.data, "folder of the recordings")->capture_default_str();
  app.add_option("--set", options.sets, "only this set; may stand several times")
      ->check(CLI::IsMember({"chest", "ilc20", "oxford", "broad", "nobody", "phone", "waist"}));
  app.add_flag("--no-magnetometer", options.no_magnetometer, "leave the magnetometer alone");
  const std::map<std::string, pdr::DetectorKind> detectors = {
      {"gait", pdr::DetectorKind::kGait},
      {"peaks", pdr::DetectorKind::kPeaks},
      {"swing", pdr::DetectorKind::kSwing},
      {"spectrum", pdr::DetectorKind::kSpectrum}};
  app.add_option("--detector", options.detector, "step detector: gait, peaks, swing or spectrum")
      ->transform(CLI::CheckedTransformer(detectors));
  const std::map<std::string, pdr::StepLengthKind> models = {
      {"combined", pdr::StepLengthKind::kCombined},
      {"linear", pdr::StepLengthKind::kLinear},
      {"weinberg", pdr::StepLengthKind::kWeinberg},
      {"fuzzy", pdr::StepLengthKind::kFuzzy}};
  app.add_option("--step-length", options.step_length, "combined, linear, weinberg or fuzzy")
      ->transform(CLI::CheckedTransformer(models));
  CLI11_PARSE(app, argc, argv);
  try {
    bool any = false;
    for (const auto& [name, set] : all_sets()) {
      const bool wanted =
          options.sets.empty() || std::count(options.sets.begin(), options.sets.end(), name) > 0;
      if (wanted) any = print_set(name, set, options) || any;
    }
    return any ? 0 : 6;
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 6;
  }
}
