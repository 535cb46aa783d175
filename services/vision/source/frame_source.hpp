#pragma once
// Recorded frames, in the order of their stamps: next_stamp() tells when the next one was taken,
// load() gives it. Frames that cannot be had come empty, with the reason, so that each recorded
// frame is accounted for. Stamps are of the sensor clock. One thread at a time.
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/time.hpp"
#include "dataset/recording.hpp"

namespace vpdr::vision {

struct Frame {
  TimestampNs stamp_ns = 0;
  cv::Mat image;        ///< empty where it cannot be had
  std::string problem;  ///< why, naming the file and the remedy
};

class FrameSource {
 public:
  virtual ~FrameSource() = default;
  /// Stamp of the next frame; nothing at the end.
  [[nodiscard]] virtual std::optional<TimestampNs> next_stamp() const = 0;
  /// The next frame; call only while next_stamp() has a value.
  virtual Frame load() = 0;
};

/// The images of a recording.
std::unique_ptr<FrameSource> make_image_list_source(std::vector<dataset::ImageEntry> images);

/// A video file whose first frame was taken at `first_ns`, the others at the file's own rate.
/// Throws FileFault where it cannot be opened or says no rate.
std::unique_ptr<FrameSource> make_video_source(const std::filesystem::path& file,
                                               TimestampNs first_ns);

}  // namespace vpdr::vision
