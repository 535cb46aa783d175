#include "dataset/sample_tables.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "dataset/csv_table.hpp"
#include "dataset/decimal_time.hpp"
#include "dataset/text_file.hpp"

namespace vpdr::dataset {
namespace {

using Kind = CsvColumn::Kind;

const std::vector<std::string_view> kRate = {"rad/s", "rad s^-1"};
const std::vector<std::string_view> kForce = {"m/s^2", "m s^-2"};

const std::array<CsvColumn, 7> kImuColumns = {{
    {{"w_x", "w_RS_S_x", "wx", "gyro_x"}, kRate, Kind::kNumber, false},
    {{"w_y", "w_RS_S_y", "wy", "gyro_y"}, kRate, Kind::kNumber, false},
    {{"w_z", "w_RS_S_z", "wz", "gyro_z"}, kRate, Kind::kNumber, false},
    {{"a_x", "a_RS_S_x", "ax", "accel_x"}, kForce, Kind::kNumber, true},
    {{"a_y", "a_RS_S_y", "ay", "accel_y"}, kForce, Kind::kNumber, true},
    {{"a_z", "a_RS_S_z", "az", "accel_z"}, kForce, Kind::kNumber, true},
    {{"temperature", "temp", "temp_C"}, {}, Kind::kIgnored, false},
}};

const std::array<CsvColumn, 3> kMagColumns = {{
    {{"m_x", "mx", "mag_x"}, {"uT"}, Kind::kNumber, true},
    {{"m_y", "my", "mag_y"}, {"uT"}, Kind::kNumber, true},
    {{"m_z", "mz", "mag_z"}, {"uT"}, Kind::kNumber, true},
}};

const std::array<CsvColumn, 2> kPressureColumns = {{
    {{"pressure", "p"}, {"Pa"}, Kind::kNumber, true},
    {{"temperature", "temp", "temp_C"}, {}, Kind::kIgnored, false},
}};

const std::array<CsvColumn, 1> kImageColumns = {{
    {{"filename", "file"}, {}, Kind::kText, true},
}};

Eigen::Vector3d vector_at(const CsvReader& row, std::size_t first) {
  return {row.number(first), row.number(first + 1), row.number(first + 2)};
}

/// Refuses the samples without a rate where others have one; a board without gyroscope has none.
void settle_missing_rates(std::vector<ImuSample>& samples,
                          const std::vector<std::uint64_t>& missing_lines, FileReport& file) {
  if (missing_lines.empty() || missing_lines.size() == samples.size()) return;
  std::erase_if(samples, [](const ImuSample& s) { return !s.has_angular_velocity; });
  for (const std::uint64_t line : missing_lines) file.refuse(RowFault::kNonFinite, line);
  file.accepted -= missing_lines.size();
}

bool is_image(const std::filesystem::path& file) {
  std::string end = file.extension().string();
  std::transform(end.begin(), end.end(), end.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return end == ".jpg" || end == ".jpeg" || end == ".png" || end == ".bmp" || end == ".pgm";
}

std::optional<TimestampNs> stamp_of_name(const std::string& stem) {
  if (stem.find('.') != std::string::npos) return parse_decimal_seconds(stem);
  constexpr std::size_t kFewestDigits = 15;
  if (stem.size() < kFewestDigits || stem.front() == '0') return std::nullopt;
  TimestampNs stamp = 0;
  const auto result = std::from_chars(stem.data(), stem.data() + stem.size(), stamp);
  if (result.ec != std::errc{} || result.ptr != stem.data() + stem.size()) return std::nullopt;
  return stamp;
}

bool stamp_by_names(std::vector<ImageEntry>& images) {
  for (ImageEntry& image : images) {
    const auto stamp = stamp_of_name(image.file.stem().string());
    if (!stamp) return false;
    image.stamp_ns = *stamp;
  }
  std::sort(images.begin(), images.end(),
            [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
  return true;
}

}  // namespace

std::vector<ImuSample> read_imu_table(const std::filesystem::path& file, ReadReport& report) {
  std::vector<ImuSample> samples;
  std::vector<std::uint64_t> missing_lines;
  FileReport result = read_table(
      file, kImuColumns, report,
      [&](const CsvReader& row) -> std::optional<RowFault> {
        ImuSample sample;
        sample.stamp_ns = row.stamp_ns();
        sample.specific_force_mps2 = vector_at(row, 3);
        const Eigen::Vector3d rate = vector_at(row, 0);
        if (!sample.specific_force_mps2.allFinite()) return RowFault::kNonFinite;
        if (rate.allFinite()) {
          sample.angular_velocity_radps = rate;
        } else if (rate.array().isNaN().all()) {
          sample.has_angular_velocity = false;
          missing_lines.push_back(row.line());
        } else {
          return RowFault::kNonFinite;
        }
        samples.push_back(sample);
        return std::nullopt;
      },
      RowsOf::kSamples);
  settle_missing_rates(samples, missing_lines, result);
  if (samples.empty()) {
    throw fault_at(file, 0, 0,
                   "no usable inertial sample in " + std::to_string(result.rows) + " rows",
                   "check the recording; it needs finite accelerations and rising stamps");
  }
  report.files.push_back(std::move(result));
  return samples;
}

std::vector<MagSample> read_mag_table(const std::filesystem::path& file, ReadReport& report) {
  std::vector<MagSample> samples;
  report.files.push_back(read_table(
      file, kMagColumns, report,
      [&](const CsvReader& row) -> std::optional<RowFault> {
        const MagSample sample{row.stamp_ns(), vector_at(row, 0)};
        if (!sample.field_ut.allFinite()) return RowFault::kNonFinite;
        samples.push_back(sample);
        return std::nullopt;
      },
      RowsOf::kSamples));
  return samples;
}

std::vector<PressureSample> read_pressure_table(const std::filesystem::path& file,
                                                ReadReport& report) {
  std::vector<PressureSample> samples;
  report.files.push_back(read_table(
      file, kPressureColumns, report,
      [&](const CsvReader& row) -> std::optional<RowFault> {
        if (!std::isfinite(row.number(0))) return RowFault::kNonFinite;
        samples.push_back({row.stamp_ns(), row.number(0)});
        return std::nullopt;
      },
      RowsOf::kSamples));
  return samples;
}

std::vector<ImageEntry> read_image_table(const std::filesystem::path& file,
                                         const std::filesystem::path& folder, ReadReport& report) {
  std::vector<ImageEntry> images;
  report.files.push_back(read_table(
      file, kImageColumns, report,
      [&](const CsvReader& row) -> std::optional<RowFault> {
        std::filesystem::path image = folder / row.text(0);
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(image, ignored)) return RowFault::kMissingFile;
        images.push_back({row.stamp_ns(), std::move(image)});
        return std::nullopt;
      },
      RowsOf::kSamples));
  return images;
}

std::vector<ImageEntry> list_images(const std::filesystem::path& folder, double nominal_rate_hz,
                                    ReadReport& report) {
  std::vector<ImageEntry> images;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.is_regular_file() && is_image(entry.path())) images.push_back({0, entry.path()});
  }
  if (images.empty() || stamp_by_names(images)) return images;
  std::sort(images.begin(), images.end(),
            [](const auto& a, const auto& b) { return a.file < b.file; });
  for (std::size_t i = 0; i < images.size(); ++i) {
    images[i].stamp_ns = to_ns(static_cast<double>(i) / nominal_rate_hz);
  }
  const std::string rate = std::to_string(nominal_rate_hz);
  report.notes.push_back(folder.string() + ": the images carry no stamps; assumed " +
                         rate.substr(0, rate.find('.') + 2) + " images/s from 0");
  return images;
}

}  // namespace vpdr::dataset
