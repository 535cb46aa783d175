#pragma once
// One frame in, what vision says of it out on the topics.
#include <memory>
#include <mutex>
#include <optional>

#include "app/service.hpp"
#include "sensor_msgs.h"
#include "vision/core/vanishing_point_heading.hpp"
#include "vision/source/frame_source.hpp"
#include "vpdr_msgs.h"

namespace vpdr::vision {

/// process() belongs to one thread at a time, report() to any.
class FrameProcessor {
 public:
  FrameProcessor(app::ServiceContext& context, bool publish_images);

  /// Before this is called frames are not processed: the camera is not known.
  void set_camera(const VisionConfig& config, const CameraModel& camera);
  /// Publishes vision/heading for each frame, found or not, and vision/heading_rate where there is
  /// one. A frame that is not later than the one before leaves no trace but a count.
  void process(const Frame& frame, const std::optional<AttitudePrior>& prior);
  void report(app::Health& health);
  /// Waits until the readers have everything.
  void close();

 private:
  void publish_image(const Frame& frame);

  std::mutex mutex_;  ///< guards vision_ and the counters
  std::optional<VanishingPointHeading> vision_;
  std::uint64_t undecodable_ = 0;
  std::uint64_t without_attitude_ = 0;
  vpdr_msgs::msg::CorridorHeading heading_message_;
  vpdr_msgs::msg::HeadingRate rate_message_;
  sensor_msgs::msg::CompressedImage image_message_;
  std::unique_ptr<dds::Publisher<vpdr_msgs::msg::CorridorHeading>> heading_publisher_;
  std::unique_ptr<dds::Publisher<vpdr_msgs::msg::HeadingRate>> rate_publisher_;
  std::unique_ptr<dds::Publisher<sensor_msgs::msg::CompressedImage>> image_publisher_;
};

}  // namespace vpdr::vision
