#include "bench/still_boards.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

#include "core/rotation.hpp"

namespace vpdr::bench {
namespace {

namespace fs = std::filesystem;

/// Rows of numbers set apart by commas or blanks; header lines are left out.
std::vector<std::array<double, 7>> read_rows(const fs::path& file, std::size_t columns) {
  std::vector<std::array<double, 7>> rows;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::array<double, 7> row{};
    const char* at = line.c_str();
    std::size_t found = 0;
    for (char* end = nullptr; found < columns; ++found, at = end) {
      row[found] = std::strtod(at, &end);
      if (end == at) break;
    }
    if (found == columns) rows.push_back(row);
  }
  return rows;
}

dataset::Recording named(const fs::path& folder, const std::string& name) {
  dataset::Recording recording;
  recording.folder = folder;
  recording.name = name;
  return recording;
}

/// Columns: seconds, three of g, three of deg/s; `rates_first` where these come first.
dataset::Recording read_six_axes(const fs::path& file, bool rates_first) {
  dataset::Recording recording = named(file.parent_path(), file.stem().string());
  const std::size_t force = rates_first ? 4 : 1;
  const std::size_t rate = rates_first ? 1 : 4;
  for (const auto& row : read_rows(file, 7)) {
    ImuSample sample;
    sample.stamp_ns = to_ns(row[0]);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      sample.specific_force_mps2[axis] = kGravityMps2 * row[force + i];
      sample.angular_velocity_radps[axis] = to_radians(row[rate + i]);
    }
    recording.imu.push_back(sample);
  }
  return recording;
}

/// accelerometer.txt and gyroscope.txt of a phone: seconds, three values in SI; the rate of the
/// latest gyroscope row goes with each accelerometer row.
dataset::Recording read_phone(const fs::path& folder) {
  dataset::Recording recording = named(folder, folder.filename().string());
  const auto rates = read_rows(folder / "gyroscope.txt", 4);
  std::size_t next = 0;
  ImuSample sample;
  sample.has_angular_velocity = !rates.empty();
  for (const auto& row : read_rows(folder / "accelerometer.txt", 4)) {
    for (; next < rates.size() && rates[next][0] <= row[0]; ++next) {
      sample.angular_velocity_radps = {rates[next][1], rates[next][2], rates[next][3]};
    }
    sample.stamp_ns = to_ns(row[0]);
    sample.specific_force_mps2 = {row[1], row[2], row[3]};
    recording.imu.push_back(sample);
  }
  return recording;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> found;
  if (!fs::is_directory(folder)) return found;
  for (const auto& entry : fs::directory_iterator(folder)) found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace

std::vector<dataset::Recording> boards_nobody_walks_with(const fs::path& boards,
                                                         const fs::path& broad) {
  std::vector<dataset::Recording> found;
  for (const fs::path& file : entries_of(boards / "mpu6050_hmc5883l_sunsided")) {
    if (file.stem().string().ends_with("_mpu6050")) found.push_back(read_six_axes(file, false));
  }
  for (const fs::path& file : entries_of(boards / "xio_fusion")) {
    if (file.extension() == ".csv") found.push_back(read_six_axes(file, true));
  }
  for (const fs::path& folder : entries_of(boards / "phone_calibration")) {
    if (fs::exists(folder / "accelerometer.txt")) found.push_back(read_phone(folder));
  }
  for (const fs::path& folder : entries_of(broad)) {
    if (folder.filename().string().find("rotation") == std::string::npos) continue;
    found.push_back(dataset::read_recording(folder, {.images = false}));
  }
  std::erase_if(found, [](const dataset::Recording& recording) { return recording.imu.empty(); });
  return found;
}

}  // namespace vpdr::bench
