#include "vision/core/frame_check.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

namespace vpdr::vision {
namespace {

constexpr int kGrid = 4;  // every fourth pixel of every fourth row

struct Levels {
  std::array<std::uint32_t, 256> counts{};
  std::uint32_t total = 0;

  [[nodiscard]] int quantile(double share) const {
    const double wanted = share * total;
    double seen = 0.0;
    for (int level = 0; level < 256; ++level) {
      seen += counts[static_cast<std::size_t>(level)];
      if (seen > wanted) return level;
    }
    return 255;
  }
};

// The green channel of a colour image is close enough to its grey.
Levels levels_of(const cv::Mat& image) {
  Levels levels;
  const int channels = image.channels();
  const int offset = channels == 1 ? 0 : 1;
  for (int row = 0; row < image.rows; row += kGrid) {
    const std::uint8_t* pixels = image.ptr<std::uint8_t>(row);
    for (int col = 0; col < image.cols; col += kGrid) {
      ++levels.counts[pixels[col * channels + offset]];
      ++levels.total;
    }
  }
  return levels;
}

// The colours with which decoders fill up what is missing: mid grey (JPEG) and black.
bool is_filling(const std::uint8_t* pixel, std::size_t channels) {
  const auto near = [&](int level) {
    return std::all_of(pixel, pixel + std::min<std::size_t>(channels, 3),
                       [&](std::uint8_t v) { return std::abs(v - level) <= 1; });
  };
  return near(128) || near(0);
}

bool is_torn(const cv::Mat& image, double fraction) {
  const auto row_bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  const std::uint8_t* last = image.ptr<std::uint8_t>(image.rows - 1);
  if (!is_filling(last, image.elemSize())) return false;
  if (std::memcmp(last, last + image.elemSize(), row_bytes - image.elemSize()) != 0) return false;
  const int flat = std::max(2, static_cast<int>(fraction * image.rows));
  for (int row = image.rows - flat; row < image.rows - 1; ++row) {
    if (row < 0 || std::memcmp(image.ptr<std::uint8_t>(row), last, row_bytes) != 0) return false;
  }
  return true;
}

}  // namespace

const char* name_of(FrameOutcome outcome) {
  static constexpr std::array<const char*, kFrameOutcomeCount> kNames = {
      "found",     "empty",       "wrong_format", "wrong_size", "not_later",
      "dark",      "saturated",   "featureless",  "torn",       "library_fault",
      "few_lines", "no_corridor", "uncertain",    "disagrees"};
  return kNames[static_cast<std::size_t>(outcome)];
}

FrameOutcome check_frame(const cv::Mat& image, int width, int height,
                         const FrameCheckConfig& config) noexcept {
  if (image.data == nullptr || image.dims != 2 || image.rows < 1 || image.cols < 1) {
    return FrameOutcome::kEmpty;
  }
  const int channels = image.channels();
  if (image.depth() != CV_8U || (channels != 1 && channels != 3 && channels != 4)) {
    return FrameOutcome::kWrongFormat;
  }
  const bool too_small = image.rows < 16 || image.cols < 16;
  if (too_small || (width > 0 && image.cols != width) || (height > 0 && image.rows != height)) {
    return FrameOutcome::kWrongSize;
  }
  const Levels levels = levels_of(image);
  if (levels.quantile(0.99) < config.dark_level) return FrameOutcome::kDark;
  if (levels.quantile(0.10) > config.saturated_level) return FrameOutcome::kSaturated;
  if (levels.quantile(0.95) - levels.quantile(0.05) < config.min_contrast) {
    return FrameOutcome::kFeatureless;
  }
  return is_torn(image, config.torn_fraction) ? FrameOutcome::kTorn : FrameOutcome::kFound;
}

}  // namespace vpdr::vision
