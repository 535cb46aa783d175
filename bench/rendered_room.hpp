#pragma once
// Vision on a recorded hand-held run in a room: real inertial samples, pictures rendered along the
// reference through the recording's own fisheye.
#include <filesystem>
#include <fstream>

namespace vpdr::bench {

/// Prints heading rate errors and drift of TUM-VI's room `number` (`roomN_gt.csv`, `roomN_imu.csv`
/// in the folder). `csv`: rows of MotionErrors, or null.
void tumvi_room(const std::filesystem::path& folder, int number, std::ofstream* csv);

}  // namespace vpdr::bench
