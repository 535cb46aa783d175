#include "vision/app/topic_frames.hpp"

#include <utility>

#include "dds/convert.hpp"
#include "vision/source/image_file.hpp"

namespace vpdr::vision {

TopicFrames::TopicFrames(app::ServiceContext& context)
    : subscription_(context.subscribe_optional(
          dds::topics::kImage, [this](const sensor_msgs::msg::CompressedImage& message,
                                      const dds::SampleInfo&) { keep(message); })) {}

void TopicFrames::keep(const sensor_msgs::msg::CompressedImage& message) {
  const std::lock_guard lock(mutex_);
  ++health_.frames;
  if (newest_) ++health_.dropped;
  newest_ = message;
  changed_.notify_all();
}

std::optional<Frame> TopicFrames::take(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  if (!changed_.wait(lock, stop, [this] { return newest_.has_value(); })) return std::nullopt;
  const sensor_msgs::msg::CompressedImage message = *std::exchange(newest_, std::nullopt);
  lock.unlock();
  Frame frame{dds::from_msg(message.header().stamp()), {}, {}};
  auto image = decode_image(message.data(), "camera/image/compressed",
                            "look at what publishes it: JPEG or PNG is read");
  if (image) {
    frame.image = std::move(image.value());
  } else {
    frame.problem = image.error().message;
  }
  return frame;
}

LiveHealth TopicFrames::health() const {
  const std::lock_guard lock(mutex_);
  LiveHealth health = health_;
  health.connected = subscription_->alive_count() > 0;
  return health;
}

}  // namespace vpdr::vision
