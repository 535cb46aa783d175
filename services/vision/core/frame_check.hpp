#pragma once
// Is this an image of the world at all? Refused frames never reach the algorithms.
#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>

namespace vpdr::vision {

/// What became of a frame. Everything but kFound means that no heading came out of it.
enum class FrameOutcome : std::uint8_t {
  kFound,         ///< corridor found
  kEmpty,         ///< no pixels
  kWrongFormat,   ///< not 8 bits with 1, 3 or 4 channels
  kWrongSize,     ///< not the size the camera is calibrated for
  kNotLater,      ///< not later than the frame before it
  kDark,          ///< almost all pixels black
  kSaturated,     ///< almost all pixels white
  kFeatureless,   ///< no contrast: lens covered
  kBlurred,       ///< no edge in it is sharp, either way: moved or out of focus
  kRepeated,      ///< pixel for pixel the frame before: the camera hangs
  kTorn,          ///< the lower part is a decoder's filling: torn file or transfer
  kLibraryFault,  ///< OpenCV gave up on it
  kFewLines,      ///< not enough straight lines
  kNoCorridor,    ///< lines, but too few agree on a building's directions
  kUncertain,     ///< directions, but too vague to be of use
  kDisagrees,     ///< far from where the turn since the last heading leads
};
inline constexpr std::size_t kFrameOutcomeCount = 16;

/// Name for diagnostics: "found", "wrong_size", "torn", ...
const char* name_of(FrameOutcome outcome);

struct FrameCheckConfig {
  double dark_level = 16.0;        ///< grey levels; a dark frame's 99 % quantile is below
  double saturated_level = 250.0;  ///< a saturated frame's 10 % quantile is above
  double min_contrast = 4.0;       ///< grey levels between the 5 % and the 95 % quantile
  double max_blur = 0.8;           ///< see blur_of(): about 4 px; 1 refuses none
  double torn_fraction = 0.1;      ///< of the rows, at the bottom, exactly mid grey or black
};

/// How little is lost when the image is smoothed over seven pixels: the share of the squared change
/// between neighbouring pixels that remains, along rows or columns, whichever is sharper. 1/7 for a
/// sharp edge, near 1 where all is smooth already (the idea of Crete et al. 2007). 8-bit images of
/// at least 16 x 16; on every eighth row and column.
double blur_of(const cv::Mat& image);

/// Equal for images equal on a grid of pixels, almost surely different otherwise.
std::uint64_t fingerprint_of(const cv::Mat& image);

/// kFound when the frame may be used. `width`, `height`: expected size, 0 for any. Format and size
/// are checked first; the levels on a grid of pixels, in well under a millisecond. Never throws.
FrameOutcome check_frame(const cv::Mat& image, int width, int height,
                         const FrameCheckConfig& config) noexcept;

}  // namespace vpdr::vision
