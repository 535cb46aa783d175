#pragma once
// York Urban: 51 buildings with true vanishing directions.
#include <filesystem>
#include <fstream>

namespace vpdr::bench {

/// Angular error of the three directions of each image, with nothing known or the vertical known
/// to one degree, and the time against OpenCV's bare LSD on the same images.
void york(const std::filesystem::path& folder, bool vertical_known, std::ofstream* csv);

}  // namespace vpdr::bench
