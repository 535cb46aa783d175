#pragma once
// The images of a folder, in the order of their names.
#include <filesystem>
#include <vector>

namespace vpdr::tool {

/// Files with an image's ending (jpg, png, bmp, tif, pgm, ppm, webp; capitals too), sorted by
/// name. Throws FileFault where the folder cannot be read or holds none.
std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder);

}  // namespace vpdr::tool
