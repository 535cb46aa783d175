#pragma once
// The sensors' tables of a recording: imu0, mag0, baro0, cam0. Each reader appends its FileReport
// to `report` and throws FileFault as read_table does.
#include <filesystem>
#include <vector>

#include "core/samples.hpp"
#include "dataset/read_report.hpp"
#include "dataset/recording.hpp"

namespace vpdr::dataset {

/// Rotation rate rad/s, specific force m/s^2, sensor axes. A table whose rates are all nan, or that
/// has none, is a board without gyroscope: has_angular_velocity is false throughout. Throws
/// FileFault where no row is usable.
std::vector<ImuSample> read_imu_table(const std::filesystem::path& file, ReadReport& report);

/// Magnetic field, microtesla, sensor axes.
std::vector<MagSample> read_mag_table(const std::filesystem::path& file, ReadReport& report);

/// Pressure, pascal.
std::vector<PressureSample> read_pressure_table(const std::filesystem::path& file,
                                                ReadReport& report);

/// Images named by the table; the files are in `folder`. Rows whose file is absent are refused.
std::vector<ImageEntry> read_image_table(const std::filesystem::path& file,
                                         const std::filesystem::path& folder, ReadReport& report);

/// Images of a folder in the order of their names, which are stamps (nanoseconds of at least 15
/// digits, or seconds with a point); other names get `nominal_rate_hz` from 0, and a note.
std::vector<ImageEntry> list_images(const std::filesystem::path& folder, double nominal_rate_hz,
                                    ReadReport& report);

}  // namespace vpdr::dataset
