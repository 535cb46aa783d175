#include "vision/source/live_camera.hpp"

#include <algorithm>
#include <cctype>
#include <opencv2/videoio.hpp>
#include <utility>

namespace vpdr::vision {
namespace {

/// The one of OpenCV's backends that is meant. Asked for any, it would try them all again each
/// second while a camera is unplugged, and some leak.
int backend_of(const std::string& camera) {
  if (camera.starts_with("/dev/")) return cv::CAP_V4L2;
  return camera.find('!') != std::string::npos ? cv::CAP_GSTREAMER : cv::CAP_FFMPEG;
}

class CameraGrabber : public Grabber {
 public:
  CameraGrabber(std::string camera, int width, int height)
      : camera_(std::move(camera)), width_(width), height_(height) {}

  bool open() override {
    try {
      const bool is_index =
          !camera_.empty() && std::all_of(camera_.begin(), camera_.end(), [](char c) {
            return std::isdigit(static_cast<unsigned char>(c)) != 0;
          });
      const bool opened = is_index ? capture_.open(std::stoi(camera_), cv::CAP_V4L2)
                                   : capture_.open(camera_, backend_of(camera_));
      if (opened && width_ > 0) capture_.set(cv::CAP_PROP_FRAME_WIDTH, width_);
      if (opened && height_ > 0) capture_.set(cv::CAP_PROP_FRAME_HEIGHT, height_);
      // Frames that wait in the driver are old frames.
      if (opened) capture_.set(cv::CAP_PROP_BUFFERSIZE, 1);
      return opened;
    } catch (const std::exception&) {
      return false;
    }
  }

  bool grab(cv::Mat& image) override {
    try {
      return capture_.read(image);
    } catch (const cv::Exception&) {
      return false;
    }
  }

 private:
  std::string camera_;
  int width_;
  int height_;
  cv::VideoCapture capture_;
};

}  // namespace

std::unique_ptr<Grabber> make_camera_grabber(const std::string& camera, int width, int height) {
  return std::make_unique<CameraGrabber>(camera, width, height);
}

LiveCamera::LiveCamera(std::unique_ptr<Grabber> grabber, LiveCameraOptions options)
    : grabber_(std::move(grabber)),
      options_(std::move(options)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void LiveCamera::run(const std::stop_token& stop) {
  cv::Mat image;
  while (!stop.stop_requested()) {
    const bool open = grabber_->open();
    {
      std::unique_lock lock(mutex_);
      health_.connected = open;
      if (open && opened_once_) ++health_.reconnections;
      opened_once_ = opened_once_ || open;
    }
    while (open && !stop.stop_requested() && grabber_->grab(image)) keep(image);
    std::unique_lock lock(mutex_);
    health_.connected = false;
    changed_.wait_for(lock, stop, options_.retry, [] { return false; });
  }
}

void LiveCamera::keep(cv::Mat& image) {
  const TimestampNs stamp = options_.clock() - to_ns(options_.latency_s);
  const std::lock_guard lock(mutex_);
  ++health_.frames;
  if (newest_) ++health_.dropped;
  newest_ = Frame{stamp, std::move(image), {}};
  image = cv::Mat();
  changed_.notify_all();
}

std::optional<Frame> LiveCamera::take(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  if (!changed_.wait(lock, stop, [this] { return newest_.has_value(); })) return std::nullopt;
  return std::exchange(newest_, std::nullopt);
}

LiveHealth LiveCamera::health() const {
  const std::lock_guard lock(mutex_);
  return health_;
}

}  // namespace vpdr::vision
