#include "dataset/truth_tables.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

#include "dataset/csv_table.hpp"
#include "dataset/decimal_time.hpp"
#include "dataset/text_file.hpp"

namespace vpdr::dataset {
namespace {

using Kind = CsvColumn::Kind;

const std::array<CsvColumn, 8> kPoseColumns = {{
    {{"p_x", "p_RS_R_x"}, {"m"}, Kind::kNumber, false},
    {{"p_y", "p_RS_R_y"}, {"m"}, Kind::kNumber, false},
    {{"p_z", "p_RS_R_z"}, {"m"}, Kind::kNumber, false},
    {{"q_w", "q_RS_w"}, {""}, Kind::kNumber, false},
    {{"q_x", "q_RS_x"}, {""}, Kind::kNumber, false},
    {{"q_y", "q_RS_y"}, {""}, Kind::kNumber, false},
    {{"q_z", "q_RS_z"}, {""}, Kind::kNumber, false},
    {{"v_RS_R_x", "v_RS_R_y", "v_RS_R_z", "v_x", "v_y", "v_z", "b_w_RS_S_x", "b_w_RS_S_y",
      "b_w_RS_S_z", "b_a_RS_S_x", "b_a_RS_S_y", "b_a_RS_S_z"},
     {},
     Kind::kIgnored,
     false},
}};

const std::array<CsvColumn, 2> kWaypointColumns = {{
    {{"x"}, {"m"}, Kind::kNumber, true},
    {{"y"}, {"m"}, Kind::kNumber, true},
}};

const std::array<CsvColumn, 2> kStepColumns = {{
    {{"length"}, {"m"}, Kind::kNumber, false},
    {{"yaw"}, {"rad"}, Kind::kIgnored, false},
}};

const std::array<CsvColumn, 1> kMovementColumns = {{
    {{"movement"}, {}, Kind::kNumber, true},
}};

/// Unit quaternion, or all nan where it is unknown or of no length.
Eigen::Quaterniond unit_or_nan(double w, double x, double y, double z) {
  Eigen::Quaterniond q(w, x, y, z);
  const double norm = q.norm();
  if (std::isfinite(norm) && norm > 0.1) return Eigen::Quaterniond(q.coeffs() / norm);
  q.coeffs().setConstant(std::numeric_limits<double>::quiet_NaN());
  return q;
}

std::optional<TruthPose> parse_tum_row(std::string_view row) {
  TruthPose pose;
  std::array<double, 7> numbers{};
  std::size_t cell = 0;
  for (std::size_t at = row.find_first_not_of(" \t"); at != row.npos;) {
    const std::size_t end = std::min(row.find_first_of(" \t", at), row.size());
    const std::string_view text = row.substr(at, end - at);
    if (cell == 0) {
      const auto stamp = parse_decimal_seconds(text);
      if (!stamp) return std::nullopt;
      pose.stamp_ns = *stamp;
    } else if (cell <= numbers.size()) {
      const auto result =
          std::from_chars(text.data(), text.data() + text.size(), numbers[cell - 1]);
      if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) return std::nullopt;
    }
    ++cell;
    at = row.find_first_not_of(" \t", end);
  }
  if (cell != 8) return std::nullopt;
  pose.position_m = Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  pose.world_from_sensor = unit_or_nan(numbers[6], numbers[3], numbers[4], numbers[5]);
  return pose;
}

std::optional<RowFault> accept_tum_row(std::string_view row, bool torn_if_bad,
                                       std::vector<TruthPose>& poses) {
  const auto pose = parse_tum_row(row);
  if (!pose) return torn_if_bad ? RowFault::kTorn : RowFault::kMalformed;
  if (!poses.empty() && pose->stamp_ns <= poses.back().stamp_ns) {
    return pose->stamp_ns == poses.back().stamp_ns ? RowFault::kDuplicate : RowFault::kBackward;
  }
  poses.push_back(*pose);
  return std::nullopt;
}

}  // namespace

std::vector<TruthPose> read_groundtruth_table(const std::filesystem::path& file,
                                              ReadReport& report) {
  std::vector<TruthPose> poses;
  report.files.push_back(
      read_table(file, kPoseColumns, report, [&](const CsvReader& row) -> std::optional<RowFault> {
        TruthPose pose;
        pose.stamp_ns = row.stamp_ns();
        pose.position_m = Eigen::Vector3d(row.number(0), row.number(1), row.number(2));
        pose.world_from_sensor =
            unit_or_nan(row.number(3), row.number(4), row.number(5), row.number(6));
        poses.push_back(pose);
        return std::nullopt;
      }));
  return poses;
}

std::vector<TruthPose> read_tum(const std::filesystem::path& file, ReadReport& report) {
  const TextFile text = read_text_file(file);
  std::vector<TruthPose> poses;
  FileReport result;
  result.file = file;
  std::uint64_t line = 0;
  for (std::size_t at = 0; at < text.text.size();) {
    const std::size_t end = std::min(text.text.find('\n', at), text.text.size());
    std::string_view row = std::string_view(text.text).substr(at, end - at);
    const bool last_without_newline = end == text.text.size();
    at = end + 1;
    ++line;
    if (row.ends_with('\r')) row.remove_suffix(1);
    const std::size_t first = row.find_first_not_of(" \t");
    if (first == row.npos || row[first] == '#') continue;
    ++result.rows;
    const auto fault = accept_tum_row(row, last_without_newline, poses);
    if (!fault) {
      ++result.accepted;
      continue;
    }
    result.refuse(*fault, line);
    if (*fault == RowFault::kMalformed && result.first_malformed.empty()) {
      result.first_malformed =
          file.string() + ":" + std::to_string(line) + ":1: not 't_s x y z qx qy qz qw'";
    }
  }
  if (result.rows > 0 && result.refused(RowFault::kMalformed) == result.rows) {
    throw FileFault(result.first_malformed + "; no row of the file can be read: check its format");
  }
  report.files.push_back(std::move(result));
  return poses;
}

std::vector<Waypoint> read_waypoint_table(const std::filesystem::path& file, ReadReport& report) {
  std::vector<Waypoint> waypoints;
  report.files.push_back(read_table(
      file, kWaypointColumns, report, [&](const CsvReader& row) -> std::optional<RowFault> {
        const Waypoint waypoint{row.stamp_ns(), {row.number(0), row.number(1)}};
        if (!waypoint.position_m.allFinite()) return RowFault::kNonFinite;
        waypoints.push_back(waypoint);
        return std::nullopt;
      }));
  return waypoints;
}

std::vector<TrueStep> read_step_table(const std::filesystem::path& file, ReadReport& report) {
  std::vector<TrueStep> steps;
  report.files.push_back(
      read_table(file, kStepColumns, report, [&](const CsvReader& row) -> std::optional<RowFault> {
        steps.push_back({row.stamp_ns(), row.number(0)});
        return std::nullopt;
      }));
  return steps;
}

std::vector<Interval> read_movement_table(const std::filesystem::path& file, ReadReport& report) {
  std::vector<Interval> intervals;
  bool moving = false;
  report.files.push_back(read_table(
      file, kMovementColumns, report, [&](const CsvReader& row) -> std::optional<RowFault> {
        const double mark = row.number(0);
        if (mark != 0.0 && mark != 1.0) return RowFault::kNonFinite;
        if (moving) intervals.back().end_ns = row.stamp_ns();
        moving = mark == 1.0;
        constexpr TimestampNs kForever = std::numeric_limits<TimestampNs>::max();
        if (moving) intervals.push_back({row.stamp_ns(), kForever});
        return std::nullopt;
      }));
  return intervals;
}

}  // namespace vpdr::dataset
