#include "evaluation/run_directory.hpp"

#include <array>
#include <nlohmann/json.hpp>

#include "dataset/csv_table.hpp"
#include "dataset/text_file.hpp"
#include "dataset/truth_tables.hpp"

namespace vpdr::evaluation {
namespace {

using Path = std::filesystem::path;
using dataset::CsvColumn;
using dataset::CsvReader;

CsvColumn number(std::string_view name, std::string_view unit) {
  return {{name}, {unit}, CsvColumn::Kind::kNumber, true};
}

/// A folder of our own making has no excuse for a bad row.
void require_clean(const dataset::FileReport& file) {
  if (file.refused() == 0) return;
  dataset::ReadReport report;
  report.files.push_back(file);
  throw FileFault(report.lines().front() + "; the run did not end well: run again");
}

void require_present(const Path& file) {
  if (std::filesystem::exists(file)) return;
  throw dataset::fault_at(file, 0, 0, "no such file",
                          "give the folder that 'vpdr run --out' wrote");
}

std::vector<StampedPose> read_poses(const Path& file) {
  require_present(file);
  dataset::ReadReport report;
  std::vector<StampedPose> poses;
  for (const dataset::TruthPose& pose : dataset::read_tum(file, report)) {
    if (!pose.has_position() || !pose.has_attitude()) {
      throw dataset::fault_at(file, 0, 0, "a pose is not finite", "run again");
    }
    poses.push_back({pose.stamp_ns, pose.position_m, pose.world_from_sensor});
  }
  require_clean(report.files.front());
  return poses;
}

/// Reads a table of finite numbers; `add` gets each row.
template <std::size_t N, class Add>
void read_numbers(const Path& file, const std::array<CsvColumn, N>& columns, Add add) {
  require_present(file);
  dataset::ReadReport report;
  require_clean(dataset::read_table(file, columns, report,
                                    [&](const CsvReader& row) -> std::optional<dataset::RowFault> {
                                      for (std::size_t i = 0; i < N; ++i) {
                                        if (!std::isfinite(row.number(i)))
                                          return dataset::RowFault::kNonFinite;
                                      }
                                      add(row);
                                      return std::nullopt;
                                    }));
}

std::vector<StampedAttitude> read_attitude(const Path& file) {
  const std::array columns = {number("q_w", ""), number("q_x", ""), number("q_y", ""),
                              number("q_z", "")};
  std::vector<StampedAttitude> rows;
  read_numbers(file, columns, [&](const CsvReader& row) {
    const Eigen::Quaterniond q(row.number(0), row.number(1), row.number(2), row.number(3));
    rows.push_back({row.stamp_ns(), q.normalized()});
  });
  return rows;
}

std::vector<RunStep> read_steps(const Path& file) {
  std::vector<RunStep> rows;
  read_numbers(file, std::array{number("length", "m"), number("yaw", "rad")},
               [&](const CsvReader& row) {
                 rows.push_back({row.stamp_ns(), row.number(0), row.number(1)});
               });
  return rows;
}

std::vector<RunVisionHeading> read_vision_heading(const Path& file) {
  const std::array columns = {number("heading", "rad"), number("pitch", "rad"),
                              number("sigma", "rad")};
  std::vector<RunVisionHeading> rows;
  read_numbers(file, columns, [&](const CsvReader& row) {
    rows.push_back({row.stamp_ns(), row.number(0), row.number(1), row.number(2)});
  });
  return rows;
}

std::vector<StampedCovariance> read_covariance(const Path& file) {
  const std::array columns = {number("var_x", "m^2"), number("var_y", "m^2"),
                              number("cov_xy", "m^2"), number("var_yaw", "rad^2")};
  std::vector<StampedCovariance> rows;
  read_numbers(file, columns, [&](const CsvReader& row) {
    StampedCovariance covariance;
    covariance.stamp_ns = row.stamp_ns();
    covariance.position_m2 << row.number(0), row.number(2), row.number(2), row.number(1);
    covariance.var_yaw_rad2 = row.number(3);
    rows.push_back(covariance);
  });
  return rows;
}

Summary read_summary(const Path& file) {
  require_present(file);
  try {
    const auto json = nlohmann::json::parse(dataset::read_text_file(file).text);
    return {json.at("steps").get<std::uint64_t>(), json.at("distance_m").get<double>(),
            json.at("duration_s").get<double>(), json.at("speed_factor").get<double>()};
  } catch (const nlohmann::json::exception& error) {
    throw dataset::fault_at(file, 0, 0, error.what(), "run again");
  }
}

}  // namespace

RunDirectory RunDirectory::read(const Path& folder) {
  if (!std::filesystem::is_directory(folder)) {
    throw dataset::fault_at(folder, 0, 0, "no such folder",
                            "give the folder that 'vpdr run --out' wrote");
  }
  RunDirectory run;
  run.folder = folder;
  run.fused = read_poses(folder / "trajectory.tum");
  run.pdr = read_poses(folder / "pdr.tum");
  run.attitude = read_attitude(folder / "attitude.csv");
  run.steps = read_steps(folder / "steps.csv");
  run.summary = read_summary(folder / "summary.json");
  if (const Path file = folder / "vision_heading.csv"; std::filesystem::exists(file)) {
    run.vision_heading = read_vision_heading(file);
  }
  if (const Path file = folder / "trajectory_covariance.csv"; std::filesystem::exists(file)) {
    run.covariance = read_covariance(file);
  }
  run.info = read_run_info(folder);
  return run;
}

}  // namespace vpdr::evaluation
