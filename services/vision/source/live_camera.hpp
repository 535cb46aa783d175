#pragma once
// A camera by index or URL. A thread of its own takes frames as they come and keeps only the
// newest: an old frame is dropped and counted, never queued. A camera that falls silent or
// vanishes is opened again, each second.
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <thread>

#include "vision/source/live_frames.hpp"

namespace vpdr::vision {

/// Where frames come from: the camera, or a test's own.
class Grabber {
 public:
  virtual ~Grabber() = default;
  /// Opens or opens again; false where there is no such camera.
  virtual bool open() = 0;
  /// Waits for the next frame; false where none came.
  virtual bool grab(cv::Mat& image) = 0;
};

/// "0" is the first camera, "/dev/video2" a device (V4L2), text with a "!" a GStreamer pipeline,
/// anything else a URL or file (FFmpeg).
/// `width`, `height`: asked of the camera, 0 for its own.
std::unique_ptr<Grabber> make_camera_grabber(const std::string& camera, int width, int height);

struct LiveCameraOptions {
  std::function<TimestampNs()> clock;     ///< the sensor clock, read when a frame is there
  double latency_s = 0.0;                 ///< from the middle of the exposure to that reading
  std::chrono::milliseconds retry{1000};  ///< between attempts to open
};

class LiveCamera : public LiveFrames {
 public:
  LiveCamera(std::unique_ptr<Grabber> grabber, LiveCameraOptions options);

  std::optional<Frame> take(const std::stop_token& stop) override;
  [[nodiscard]] LiveHealth health() const override;

 private:
  void run(const std::stop_token& stop);
  void keep(cv::Mat& image);

  std::unique_ptr<Grabber> grabber_;
  LiveCameraOptions options_;
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<Frame> newest_;
  LiveHealth health_;
  bool opened_once_ = false;
  std::jthread thread_;  // last: the first to stop
};

}  // namespace vpdr::vision
