#include "vision/core/frame_analysis.hpp"

#include <opencv2/imgproc.hpp>

namespace vpdr::vision {
namespace {

constexpr double kEarlyShare = 0.9;  // of the period: frames are not quite regular

}  // namespace

FrameAnalysis::FrameAnalysis(const AnalysisConfig& config, const CameraModel& camera)
    : heading_period_s_(config.heading_period_s),
      heading_(config.heading, camera),
      odometry_(config.odometry, config.heading.directions.frame_check, camera) {}

OdometryOutput FrameAnalysis::look_for_motion(const cv::Mat& image, TimestampNs stamp_ns,
                                              const std::optional<AttitudePrior>& attitude,
                                              const std::optional<Eigen::Vector3d>& up_camera) {
  OdometryInput input{image, stamp_ns, attitude, up_camera};
  const bool colour =
      image.depth() == CV_8U && !image.empty() && (image.channels() == 3 || image.channels() == 4);
  if (colour) {
    cv::cvtColor(image, grey_, image.channels() == 3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
    input.grey = grey_;
  }
  return odometry_.process(input);
}

bool FrameAnalysis::heading_is_due(TimestampNs stamp_ns) const {
  return !last_heading_ns_ ||
         to_seconds(stamp_ns - *last_heading_ns_) >= kEarlyShare * heading_period_s_;
}

VisionOutput FrameAnalysis::look_for_heading(const cv::Mat& image, TimestampNs stamp_ns,
                                             const std::optional<AttitudePrior>& attitude) {
  if (!last_heading_ns_ || stamp_ns > *last_heading_ns_) last_heading_ns_ = stamp_ns;
  return heading_.process(image, stamp_ns, attitude);
}

}  // namespace vpdr::vision
