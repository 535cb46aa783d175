#pragma once
// One image file, read whole and checked before it is decoded, so that a torn one is told from a
// good one whatever the decoder makes of it. Pure functions, thread-safe; no OpenCV exception
// comes out.
#include <filesystem>
#include <opencv2/core/mat.hpp>

#include "core/result.hpp"

namespace vpdr::vision {

/// 8-bit grey pixels, or why there are none: the file is absent, empty, torn or no image. The
/// message names the file and the remedy.
Result<cv::Mat> read_image(const std::filesystem::path& file);

}  // namespace vpdr::vision
