#include "vision/source/frame_source.hpp"

#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <utility>

#include "core/errors.hpp"
#include "vision/source/image_file.hpp"

namespace vpdr::vision {
namespace {

class ImageListSource : public FrameSource {
 public:
  explicit ImageListSource(std::vector<dataset::ImageEntry> images) : images_(std::move(images)) {}

  [[nodiscard]] std::optional<TimestampNs> next_stamp() const override {
    if (next_ == images_.size()) return std::nullopt;
    return images_[next_].stamp_ns;
  }

  Frame load() override {
    const dataset::ImageEntry& entry = images_[next_++];
    Frame frame{entry.stamp_ns, {}, {}};
    auto read = read_image(entry.file);
    if (read) {
      frame.image = std::move(read.value());
    } else {
      frame.problem = read.error().message;
    }
    return frame;
  }

 private:
  std::vector<dataset::ImageEntry> images_;
  std::size_t next_ = 0;
};

// One frame is read ahead, for only reading tells whether there is another one.
class VideoSource : public FrameSource {
 public:
  VideoSource(const std::filesystem::path& file, TimestampNs first_ns)
      : capture_(file.string(), cv::CAP_FFMPEG), first_ns_(first_ns) {
    if (!capture_.isOpened()) {
      throw FileFault(file.string() +
                      ": video cannot be opened; convert it to H.264 in an .mp4 file");
    }
    rate_hz_ = capture_.get(cv::CAP_PROP_FPS);
    if (!(rate_hz_ > 0.1 && rate_hz_ < 1000.0)) {
      throw FileFault(file.string() + ": video says no frame rate; convert it to a constant one");
    }
    read_ahead();
  }

  [[nodiscard]] std::optional<TimestampNs> next_stamp() const override {
    if (ahead_.empty()) return std::nullopt;
    return first_ns_ + to_ns(static_cast<double>(index_) / rate_hz_);
  }

  Frame load() override {
    Frame frame{next_stamp().value_or(first_ns_), {}, {}};
    cv::cvtColor(ahead_, frame.image, cv::COLOR_BGR2GRAY);
    ++index_;
    read_ahead();
    return frame;
  }

 private:
  void read_ahead() {
    try {
      if (!capture_.read(ahead_)) ahead_.release();
    } catch (const cv::Exception&) {
      ahead_.release();
    }
  }

  cv::VideoCapture capture_;
  TimestampNs first_ns_;
  double rate_hz_ = 0.0;
  std::int64_t index_ = 0;
  cv::Mat ahead_;
};

}  // namespace

std::unique_ptr<FrameSource> make_image_list_source(std::vector<dataset::ImageEntry> images) {
  return std::make_unique<ImageListSource>(std::move(images));
}

std::unique_ptr<FrameSource> make_video_source(const std::filesystem::path& file,
                                               TimestampNs first_ns) {
  return std::make_unique<VideoSource>(file, first_ns);
}

}  // namespace vpdr::vision
