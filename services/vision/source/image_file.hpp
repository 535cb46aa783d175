#pragma once
// One image file or message, read whole and checked before it is decoded, so that a torn one is
// told from a good one whatever the decoder makes of it. Pure functions, thread-safe; no OpenCV
// exception comes out.
#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "core/result.hpp"

namespace vpdr::vision {

/// 8-bit grey pixels, or why there are none: the file is absent, empty, torn or no image. The
/// message names the file and the remedy.
Result<cv::Mat> read_image(const std::filesystem::path& file);

/// The same of bytes that came some other way: `name` and `remedy` are for the message.
Result<cv::Mat> decode_image(const std::vector<std::uint8_t>& bytes, const std::string& name,
                             const char* remedy);

}  // namespace vpdr::vision
