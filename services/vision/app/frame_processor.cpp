#include "vision/app/frame_processor.hpp"

#include <spdlog/spdlog.h>

#include <opencv2/imgcodecs.hpp>
#include <string>

#include "dds/convert.hpp"

namespace vpdr::vision {
namespace {

constexpr std::chrono::seconds kHandOverTimeout{5};
constexpr int kJpegQuality = 80;
/// A recording full of bad images names the first ones; the count tells the rest.
constexpr std::uint64_t kNamedProblems = 10;

}  // namespace

FrameProcessor::FrameProcessor(app::ServiceContext& context, bool publish_images)
    : heading_publisher_(context.advertise(dds::topics::kCorridorHeading)),
      rate_publisher_(context.advertise(dds::topics::kHeadingRate)) {
  if (publish_images) image_publisher_ = context.advertise(dds::topics::kImage);
}

void FrameProcessor::set_camera(const VisionConfig& config, const CameraModel& camera) {
  const std::lock_guard lock(mutex_);
  vision_.emplace(config, camera);
}

void FrameProcessor::process(const Frame& frame, const std::optional<AttitudePrior>& prior) {
  const std::lock_guard lock(mutex_);
  if (!vision_) return;
  if (!frame.problem.empty() && ++undecodable_ <= kNamedProblems) {
    spdlog::warn("{}", frame.problem);
  }
  if (!prior) ++without_attitude_;
  const VisionOutput seen = vision_->process(frame.image, frame.stamp_ns, prior);
  if (seen.outcome == FrameOutcome::kNotLater) return;
  dds::to_msg(seen.heading, heading_message_);
  heading_publisher_->publish(heading_message_);
  if (seen.rate) {
    dds::to_msg(*seen.rate, rate_message_);
    rate_publisher_->publish(rate_message_);
  }
  if (image_publisher_ && !frame.image.empty()) publish_image(frame);
}

void FrameProcessor::publish_image(const Frame& frame) {
  auto& bytes = image_message_.data();
  try {
    if (!cv::imencode(".jpg", frame.image, bytes, {cv::IMWRITE_JPEG_QUALITY, kJpegQuality})) return;
  } catch (const cv::Exception&) {
    return;
  }
  dds::to_msg(frame.stamp_ns, image_message_.header().stamp());
  image_message_.header().frame_id("camera_link");
  image_message_.format("jpeg");
  image_publisher_->publish(image_message_);
}

void FrameProcessor::report(app::Health& health) {
  const std::lock_guard lock(mutex_);
  if (!vision_) return;
  std::uint64_t frames = 0;
  for (std::size_t i = 0; i < kFrameOutcomeCount; ++i) {
    const auto outcome = static_cast<FrameOutcome>(i);
    frames += vision_->count(outcome);
    health.count(std::string("frames.") + name_of(outcome), vision_->count(outcome));
  }
  health.count("frames", frames);
  health.count("frames.undecodable", undecodable_);
  health.count("frames.without_attitude", without_attitude_);
}

void FrameProcessor::close() {
  heading_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  rate_publisher_->wait_for_acknowledgments(kHandOverTimeout);
}

}  // namespace vpdr::vision
