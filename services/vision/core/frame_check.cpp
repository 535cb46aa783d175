#include "vision/core/frame_check.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

namespace vpdr::vision {
namespace {

constexpr int kGrid = 4;       // every fourth pixel of every fourth row
constexpr int kBlurGrid = 8;   // every eighth row and column
constexpr int kSmoothing = 7;  // pixels, odd

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

struct Changes {
  double before = 0.0;  ///< sum of the squared changes between neighbours
  double after = 0.0;   ///< the same once smoothed
};

// Along one line of pixels, `step` bytes apart.
void add_changes(const std::uint8_t* pixels, int count, std::size_t step, Changes& changes) {
  const auto at = [&](int i) {
    return static_cast<int>(pixels[static_cast<std::size_t>(i) * step]);
  };
  for (int i = kSmoothing; i < count; ++i) {
    const int smoothed = at(i) - at(i - kSmoothing);
    const int change = at(i - kSmoothing / 2) - at(i - kSmoothing / 2 - 1);
    changes.after += static_cast<double>(smoothed * smoothed) / (kSmoothing * kSmoothing);
    changes.before += static_cast<double>(change * change);
  }
}

double share_left(const Changes& c) { return c.before > 0.0 ? c.after / c.before : 1.0; }

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
      "found",     "empty",       "wrong_format", "wrong_size", "not_later", "dark",
      "saturated", "featureless", "blurred",      "repeated",   "torn",      "library_fault",
      "few_lines", "no_corridor", "uncertain",    "disagrees"};
  return kNames[static_cast<std::size_t>(outcome)];
}

double blur_of(const cv::Mat& image) {
  const std::size_t pixel = image.elemSize();
  const std::size_t offset = image.channels() == 1 ? 0 : 1;
  Changes rows;
  Changes columns;
  for (int row = kBlurGrid / 2; row < image.rows; row += kBlurGrid) {
    add_changes(image.ptr<std::uint8_t>(row) + offset, image.cols, pixel, rows);
  }
  for (int column = kBlurGrid / 2; column < image.cols; column += kBlurGrid) {
    add_changes(image.ptr<std::uint8_t>(0) + static_cast<std::size_t>(column) * pixel + offset,
                image.rows, image.step[0], columns);
  }
  return std::min(share_left(rows), share_left(columns));
}

// FNV-1a.
std::uint64_t fingerprint_of(const cv::Mat& image) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto bytes = static_cast<std::size_t>(image.cols) * image.elemSize();
  for (int row = 0; row < image.rows; row += kGrid) {
    const std::uint8_t* pixels = image.ptr<std::uint8_t>(row);
    for (std::size_t i = 0; i < bytes; i += kGrid - 1) {
      hash = (hash ^ pixels[i]) * 1099511628211ULL;
    }
  }
  return hash;
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
  if (is_torn(image, config.torn_fraction)) return FrameOutcome::kTorn;
  return config.max_blur < 1.0 && blur_of(image) > config.max_blur ? FrameOutcome::kBlurred
                                                                   : FrameOutcome::kFound;
}

}  // namespace vpdr::vision
