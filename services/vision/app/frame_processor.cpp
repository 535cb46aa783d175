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
      rate_publisher_(context.advertise(dds::topics::kHeadingRate)),
      motion_publisher_(context.advertise(dds::topics::kMotion)),
      odometry_publisher_(context.advertise(dds::topics::kVisionOdometry)) {
  if (publish_images) image_publisher_ = context.advertise(dds::topics::kImage);
}

void FrameProcessor::set_camera(const AnalysisConfig& config, const CameraModel& camera) {
  const std::scoped_lock lock(motion_mutex_, heading_mutex_);
  vision_.emplace(config, camera);
}

void FrameProcessor::add(const StepEvent& step) {
  const std::lock_guard lock(motion_mutex_);
  if (vision_) vision_->add(step);
}

void FrameProcessor::process(const Frame& frame, const std::optional<AttitudePrior>& prior) {
  const bool due = heading_is_due(frame.stamp_ns);
  // Without an attitude the corridor's vertical is what motion has.
  if (due && !prior) look_for_heading(frame, prior);
  look_for_motion(frame, prior);
  if (due && prior) look_for_heading(frame, prior);
}

void FrameProcessor::look_for_motion(const Frame& frame,
                                     const std::optional<AttitudePrior>& prior) {
  const std::lock_guard lock(motion_mutex_);
  if (!vision_) return;
  if (!frame.problem.empty() && ++undecodable_ <= kNamedProblems) {
    spdlog::warn("{}", frame.problem);
  }
  if (!prior) ++without_attitude_;
  const OdometryOutput seen =
      vision_->look_for_motion(frame.image, frame.stamp_ns, prior, up_camera_);
  up_camera_.reset();
  if (seen.motion) {
    dds::to_msg(*seen.motion, motion_message_);
    motion_publisher_->publish(motion_message_);
  }
  if (seen.odometry) {
    dds::to_msg(*seen.odometry, dds::Frame::kOdom, odometry_message_);
    odometry_publisher_->publish(odometry_message_);
  }
  if (image_publisher_ && !frame.image.empty()) publish_image(frame);
}

bool FrameProcessor::heading_is_due(TimestampNs stamp_ns) {
  const std::lock_guard lock(heading_mutex_);
  return vision_ && vision_->heading_is_due(stamp_ns);
}

void FrameProcessor::look_for_heading(const Frame& frame,
                                      const std::optional<AttitudePrior>& prior) {
  VisionOutput seen;
  {
    const std::lock_guard lock(heading_mutex_);
    if (!vision_) return;
    seen = vision_->look_for_heading(frame.image, frame.stamp_ns, prior);
  }
  if (seen.outcome == FrameOutcome::kNotLater) return;
  if (seen.outcome == FrameOutcome::kFound && !prior) {
    const std::lock_guard lock(motion_mutex_);
    up_camera_ = seen.frame->camera_from_corridor.col(2);
  }
  dds::to_msg(seen.heading, heading_message_);
  heading_publisher_->publish(heading_message_);
  if (seen.rate) {
    dds::to_msg(*seen.rate, rate_message_);
    rate_publisher_->publish(rate_message_);
  }
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
  const std::scoped_lock lock(motion_mutex_, heading_mutex_);
  if (!vision_) return;
  std::uint64_t frames = 0;
  for (std::size_t i = 0; i < kFrameOutcomeCount; ++i) {
    const auto outcome = static_cast<FrameOutcome>(i);
    const std::uint64_t count = vision_->heading().count(outcome);
    frames += count;
    health.count(std::string("frames.") + name_of(outcome), count);
  }
  health.count("frames", frames);
  health.count("frames.undecodable", undecodable_);
  health.count("frames.without_attitude", without_attitude_);
  for (std::size_t i = 0; i < kMotionOutcomeCount; ++i) {
    const auto outcome = static_cast<MotionOutcome>(i);
    health.count(std::string("motion.") + name_of(outcome), vision_->odometry().count(outcome));
  }
  const MetricScale& scale = vision_->odometry().scale();
  health.count("scale.from_floor", scale.floor_looks());
  health.count("scale.from_steps", scale.step_looks());
  health.count("scale.refused", scale.refused());
}

void FrameProcessor::close() {
  heading_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  rate_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  motion_publisher_->wait_for_acknowledgments(kHandOverTimeout);
  odometry_publisher_->wait_for_acknowledgments(kHandOverTimeout);
}

}  // namespace vpdr::vision
