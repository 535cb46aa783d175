// How well pdr does on real recordings, with its default configuration for everything:
//   bench_pdr_accuracy [DATA] [--set NAME]... [--no-magnetometer] [--detector NAME]
//                      [--silent S --every S] [--across DEG] [--turned-over DEG]
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
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "bench/carried_otherwise.hpp"
#include "bench/pdr_figures.hpp"
#include "bench/still_boards.hpp"
#include "core/reading.hpp"
#include "core/rotation.hpp"
#include "dataset/recording.hpp"
#include "pdr/core/pdr.hpp"

namespace {

namespace fs = std::filesystem;
using namespace vpdr;  // NOLINT: a program, not a header
using bench::Result, bench::Row;

struct Options {
  fs::path data;
  std::vector<std::string> sets;
  bool no_magnetometer = false;
  pdr::DetectorKind detector = pdr::DetectorKind::kGait;
  pdr::StepLengthKind step_length = pdr::StepLengthKind::kCombined;
  double silent_s = 0.0;  ///< the last of each `every_s` that the board is not heard
  double every_s = 5.0;
  double across_deg = 0.0;
  double turned_over_deg = 0.0;
};

using Recordings = std::vector<dataset::Recording>;

struct Set {
  std::function<Recordings(const fs::path& data)> recordings;
  std::vector<std::string> columns;
  std::function<Row(const Result&)> figures;
};

bool is_heard(TimestampNs since_start, const Options& options) {
  return std::fmod(to_seconds(since_start), options.every_s) <= options.every_s - options.silent_s;
}

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
    if (!is_heard(stamp_of(reading) - recording.imu.front().stamp_ns, options)) continue;
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
        {"mean m", "final m", "final %", "max m", "turned m", "scaled m", "turn +-deg", "NEES",
         "inside %", "scale +-%", "x real time"},
        bench::waypoint_figures}},
      {"chest",
       {mounted("walks/chest_xsens", "+z", "+x"),
        {"steps", "path m", "apart m", "towards deg"},
        bench::there_and_back_figures}},
      {"oxford",
       {in_folders({"steps/oxford_validation", "steps/oxford_optimisation"}),
        {"true", "counted", "error %"},
        bench::step_figures}},
      {"broad",
       {in_folders({"ahrs/broad"}),
        {"total deg", "heading", "inclination", "false steps"},
        bench::attitude_figures}},
      {"phone",
       {mounted("walks/phone_mocap", "+y", "+z"),
        {"total deg", "heading", "inclination", "steps", "path m", "fitted m", "mean m",
         "inside %"},
        bench::attitude_and_position_figures}},
      {"nobody", {nobody_walks, {"steps", "minutes", "steps/hour"}, bench::hourly_figures}},
      {"waist",
       {in_folders({"walks/mobilised_waist"}),
        {"true", "counted", "error %", "height m", "floors", "recall %", "precision %", "offset s",
         "length bias %", "distance +-%"},
        bench::timing_figures}},
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

/// Of the sizes, where the column's name has "+-" in it.
Row mean_of(const std::vector<Row>& rows, const std::vector<std::string>& columns) {
  Row mean(columns.size(), 0.0);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const bool of_sizes = columns[i].find("+-") != std::string::npos;
    double count = 0.0;
    for (const Row& row : rows) {
      if (std::isnan(row[i])) continue;
      mean[i] += of_sizes ? std::abs(row[i]) : row[i];
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
  for (dataset::Recording& recording : set.recordings(options.data)) {
    bench::hold_across(recording, to_radians(options.across_deg));
    bench::turn_over(recording, to_radians(options.turned_over_deg));
    rows.push_back(set.figures(run_pdr(recording, options)));
    print_row(recording.name, rows.back(), set.columns);
  }
  if (rows.empty()) {
    std::printf("  skipped: no data\n\n");
    return false;
  }
  Row mean = mean_of(rows, set.columns);
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
  app.add_option("--silent", options.silent_s, "s, how long the board falls silent")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--every", options.every_s, "s, how often it does")->check(CLI::PositiveNumber);
  app.add_option("--across", options.across_deg,
                 "deg, by which the device is turned about its upward axis");
  app.add_option("--turned-over", options.turned_over_deg,
                 "deg, by which the device is turned about its lateral axis in mid-walk");
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
