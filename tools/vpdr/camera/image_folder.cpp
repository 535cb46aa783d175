#include "vpdr/camera/image_folder.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>
#include <system_error>

#include "core/errors.hpp"

namespace vpdr::tool {
namespace {

bool is_image(const std::filesystem::path& file) {
  static constexpr std::array<std::string_view, 9> kEndings{
      ".jpg", ".jpeg", ".png", ".bmp", ".tif", ".tiff", ".pgm", ".ppm", ".webp"};
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

}  // namespace

std::vector<std::filesystem::path> images_in(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> files;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (is_image(it->path())) files.push_back(it->path());
  }
  if (error)
    throw FileFault(folder.string() + ": " + error.message() + "; give a folder of images");
  if (files.empty()) {
    throw FileFault(folder.string() +
                    ": no images; the folder itself must hold .jpg or .png files");
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace vpdr::tool
