#pragma once
// The images that another process publishes on camera/image/compressed, as live frames: stamped by
// their sender, decoded by who takes them, so that an image nobody takes costs nothing.
#include <condition_variable>
#include <memory>
#include <mutex>

#include "app/service.hpp"
#include "sensor_msgs.h"
#include "vision/source/live_frames.hpp"

namespace vpdr::vision {

class TopicFrames : public LiveFrames {
 public:
  explicit TopicFrames(app::ServiceContext& context);

  /// A message that does not decode gives a frame without pixels, with the reason.
  std::optional<Frame> take(const std::stop_token& stop) override;
  /// Connected while a publisher is alive.
  [[nodiscard]] LiveHealth health() const override;

 private:
  void keep(const sensor_msgs::msg::CompressedImage& message);

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<sensor_msgs::msg::CompressedImage> newest_;
  LiveHealth health_;
  // Last, so that no image comes before everything above is there.
  std::unique_ptr<dds::Subscription<sensor_msgs::msg::CompressedImage>> subscription_;
};

}  // namespace vpdr::vision
