#pragma once
// One frame in, what vision says of it out on the topics.
#include <memory>
#include <mutex>
#include <optional>

#include "app/service.hpp"
#include "nav_msgs.h"
#include "sensor_msgs.h"
#include "vision/core/frame_analysis.hpp"
#include "vision/source/frame_source.hpp"
#include "vpdr_msgs.h"

namespace vpdr::vision {

/// look_for_motion() and add() may be called beside look_for_heading(), each by one thread at a
/// time; report() by any.
class FrameProcessor {
 public:
  FrameProcessor(app::ServiceContext& context, bool publish_images);

  /// Before this is called frames are not processed: the camera is not known.
  void set_camera(const AnalysisConfig& config, const CameraModel& camera);
  /// A step of the walker, as pdr sees it.
  void add(const StepEvent& step);
  /// Motion and, where it is due, heading.
  void process(const Frame& frame, const std::optional<AttitudePrior>& prior);
  /// Publishes vision/motion and, once the scale is known, vision/odometry. A frame that is not
  /// later than the one before leaves no trace but a count; so for the heading.
  void look_for_motion(const Frame& frame, const std::optional<AttitudePrior>& prior);
  [[nodiscard]] bool heading_is_due(TimestampNs stamp_ns);
  /// Publishes vision/heading, found or not, and vision/heading_rate where there is one.
  void look_for_heading(const Frame& frame, const std::optional<AttitudePrior>& prior);
  void report(app::Health& health);
  /// Waits until the readers have everything.
  void close();

 private:
  void publish_image(const Frame& frame);

  std::optional<FrameAnalysis> vision_;
  std::mutex motion_mutex_;  ///< guards the motion part of vision_ and the counters
  std::uint64_t undecodable_ = 0;
  std::uint64_t without_attitude_ = 0;
  std::optional<Eigen::Vector3d> up_camera_;  ///< of the last corridor; motion_mutex_
  std::mutex heading_mutex_;                  ///< guards the heading part of vision_
  vpdr_msgs::msg::Motion motion_message_;
  nav_msgs::msg::Odometry odometry_message_;
  vpdr_msgs::msg::CorridorHeading heading_message_;
  vpdr_msgs::msg::HeadingRate rate_message_;
  sensor_msgs::msg::CompressedImage image_message_;
  std::unique_ptr<dds::Publisher<vpdr_msgs::msg::CorridorHeading>> heading_publisher_;
  std::unique_ptr<dds::Publisher<vpdr_msgs::msg::HeadingRate>> rate_publisher_;
  std::unique_ptr<dds::Publisher<vpdr_msgs::msg::Motion>> motion_publisher_;
  std::unique_ptr<dds::Publisher<nav_msgs::msg::Odometry>> odometry_publisher_;
  std::unique_ptr<dds::Publisher<sensor_msgs::msg::CompressedImage>> image_publisher_;
};

}  // namespace vpdr::vision
