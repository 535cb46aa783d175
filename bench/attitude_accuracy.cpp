// How well pdr's attitude filter does on recordings with an optical reference, with its default
// configuration for everything:
//   bench_attitude_accuracy [DATA] [--complementary]
// DATA (default $VPDR_DATA, then ../shared/data) is the folder of recordings. Three groups: BROAD
// (20 trials), phone walks in an undisturbed room, phone walks beside magnets. Columns: root mean
// square error, total, heading and inclination, deg; NEES, the mean of e' P^-1 e / 3, that of
// heading and of inclination alone, and the share of time the whole is below the 95 % bound of its
// chi^2, %; drift of yaw without the magnetometer, deg/min, from first to last reference row. Below
// each group the mean, and the median drift.
#include <CLI/CLI.hpp>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "core/rotation.hpp"
#include "core/sample_gate.hpp"
#include "dataset/recording.hpp"
#include "pdr/core/attitude/attitude_filter.hpp"

namespace {

namespace fs = std::filesystem;
using namespace vpdr;  // NOLINT: a program, not a header
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Error of the estimate at one row of the reference.
struct ErrorRow {
  double t_s = 0.0;
  Quaterniond error = Quaterniond::Identity();  ///< estimate times conjugate of reference
  double nees = 0.0;
  double nees_heading = 0.0;
  double nees_inclination = 0.0;
};

enum Column {
  kTotal,
  kHeading,
  kInclination,
  kNees,
  kNeesHeading,
  kNeesInclination,
  kInside,
  kDrift,
  kColumns
};
using Figures = std::array<double, kColumns>;
constexpr std::array<const char*, kColumns> kNames = {"total deg", "heading",      "inclination",
                                                      "NEES",      "of heading",   "inclination",
                                                      "in 95 %",   "drift deg/min"};
/// 95 % bound of chi^2 with 3 degrees of freedom.
constexpr double kChiSquare95 = 7.815;

bool counts(const dataset::Recording& recording, const dataset::TruthPose& pose) {
  const auto within = [&pose](const std::vector<dataset::Interval>& intervals) {
    return std::any_of(intervals.begin(), intervals.end(),
                       [&pose](const auto& i) { return i.contains(pose.stamp_ns); });
  };
  if (!pose.has_attitude() || within(recording.about.reference_faults)) return false;
  return !recording.truth.movement || within(*recording.truth.movement);
}

ErrorRow compare(const AttitudeEstimate& before, const AttitudeEstimate& after,
                 const dataset::TruthPose& truth) {
  const double share =
      to_seconds(truth.stamp_ns - before.stamp_ns) / to_seconds(after.stamp_ns - before.stamp_ns);
  ErrorRow row;
  row.t_s = to_seconds(truth.stamp_ns);
  row.error = before.world_from_body.slerp(share, after.world_from_body) *
              truth.world_from_sensor.conjugate();
  const Vector3d e = log_rotation(row.error);
  const Matrix3d& p = after.covariance_rad2;
  row.nees = e.dot(p.inverse() * e) / 3.0;
  row.nees_heading = e.z() * e.z() / p(2, 2);
  row.nees_inclination = e.head<2>().dot(p.topLeftCorner<2, 2>().inverse() * e.head<2>()) / 2.0;
  return row;
}

/// `recording` has been turned to body axes, its reference with it.
std::vector<ErrorRow> run(const dataset::Recording& recording, const pdr::AttitudeConfig& config) {
  pdr::AttitudeFilter filter(config);
  SampleGate imu_gate;
  SampleGate mag_gate;
  std::vector<ErrorRow> rows;
  AttitudeEstimate before;
  std::size_t mag = 0;
  std::size_t truth = 0;
  const auto& poses = recording.truth.poses;
  for (const ImuSample& sample : recording.imu) {
    for (; mag < recording.mag.size() && recording.mag[mag].stamp_ns <= sample.stamp_ns; ++mag) {
      if (mag_gate.check(recording.mag[mag]) == Refusal::kNone) filter.process(recording.mag[mag]);
    }
    if (imu_gate.check(sample) != Refusal::kNone) continue;
    const bool first = !filter.initialised();
    filter.process(sample);
    const AttitudeEstimate after = filter.estimate();
    for (; truth < poses.size() && poses[truth].stamp_ns <= sample.stamp_ns; ++truth) {
      if (first || poses[truth].stamp_ns < before.stamp_ns) continue;
      if (counts(recording, poses[truth])) rows.push_back(compare(before, after, poses[truth]));
    }
    before = after;
  }
  return rows;
}

double heading_of(const Quaterniond& error) {
  return wrap_pi(2.0 * std::atan2(error.z(), error.w()));
}

/// Change of the heading error from the first row to the last, unwrapped, deg/min.
double drift(const std::vector<ErrorRow>& rows) {
  double turned = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    turned += wrap_pi(heading_of(rows[i].error) - heading_of(rows[i - 1].error));
  }
  return to_degrees(std::abs(turned)) * 60.0 / (rows.back().t_s - rows.front().t_s);
}

Figures figures(const dataset::Recording& recording, pdr::AttitudeConfig config) {
  config.magnetic.declination_rad = recording.about.declination_rad;
  const std::vector<ErrorRow> rows = run(recording, config);
  Figures out{};
  if (rows.empty()) return out;
  const auto n = static_cast<double>(rows.size());
  for (const ErrorRow& row : rows) {
    const Quaterniond& e = row.error;
    const double heading = heading_of(e);
    const double total = 2.0 * std::atan2(e.vec().norm(), std::abs(e.w()));
    const double inclination = 2.0 * std::atan2(std::hypot(e.x(), e.y()), std::hypot(e.w(), e.z()));
    out[kTotal] += total * total / n;
    out[kHeading] += heading * heading / n;
    out[kInclination] += inclination * inclination / n;
    out[kNees] += row.nees / n;
    out[kNeesHeading] += row.nees_heading / n;
    out[kNeesInclination] += row.nees_inclination / n;
    out[kInside] += 3.0 * row.nees < kChiSquare95 ? 100.0 / n : 0.0;
  }
  for (const Column column : {kTotal, kHeading, kInclination}) {
    out[column] = to_degrees(std::sqrt(out[column]));
  }
  config.use_magnetometer = false;
  out[kDrift] = drift(run(recording, config));
  return out;
}

void print(const std::string& name, const Figures& values) {
  std::printf("  %-46s", name.c_str());
  for (std::size_t i = 0; i < kColumns; ++i) std::printf("%14.2f", values[i]);
  std::printf("\n");
}

void print_group(const std::string& name, const std::vector<fs::path>& folders,
                 const pdr::AttitudeConfig& config) {
  std::printf("%-48s", name.c_str());
  for (const char* const column : kNames) std::printf("%14s", column);
  std::printf("\n");
  Figures mean{};
  std::vector<double> drifts;
  for (const fs::path& folder : folders) {
    dataset::Recording recording = dataset::read_recording(folder, {.images = false});
    dataset::apply_mount(recording);
    const Figures values = figures(recording, config);
    print(recording.name, values);
    for (std::size_t i = 0; i < kColumns; ++i) {
      mean[i] += values[i] / static_cast<double>(folders.size());
    }
    drifts.push_back(values[kDrift]);
  }
  if (folders.empty()) {
    std::printf("  skipped: no data\n\n");
    return;
  }
  print("mean of " + std::to_string(folders.size()), mean);
  std::sort(drifts.begin(), drifts.end());
  const std::size_t middle = drifts.size() / 2;
  const double median =
      drifts.size() % 2 == 1 ? drifts[middle] : 0.5 * (drifts[middle - 1] + drifts[middle]);
  std::printf("  median drift without magnetometer %.2f deg/min\n\n", median);
}

std::vector<fs::path> recordings_in(const fs::path& folder, const std::string& part) {
  std::vector<fs::path> found;
  if (!fs::is_directory(folder)) return found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const bool named = entry.path().filename().string().find(part) != std::string::npos;
    if (entry.is_directory() && named) found.push_back(entry.path());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  const char* const named = std::getenv("VPDR_DATA");
  fs::path data = named != nullptr ? named : "../shared/data";
  bool complementary = false;
  CLI::App app("How well pdr's attitude filter does on recordings with an optical reference.");
  app.add_option("DATA", data, "folder of the recordings")->capture_default_str();
  app.add_flag("--complementary", complementary, "the AHRS paper's filter in the default's place");
  CLI11_PARSE(app, argc, argv);
  pdr::AttitudeConfig config;
  if (complementary) config.filter = pdr::AttitudeMethod::kComplementary;
  try {
    const fs::path phone = data / "walks/phone_mocap";
    print_group("BROAD", recordings_in(data / "ahrs/broad", ""), config);
    print_group("phone, undisturbed", recordings_in(phone, "_NoDist_"), config);
    print_group("phone, beside magnets", recordings_in(phone, "_Dist_"), config);
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "%s\n", fault.what());
    return 6;
  }
  return 0;
}
