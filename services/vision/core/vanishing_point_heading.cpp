#include "vision/core/vanishing_point_heading.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/rotation.hpp"

namespace vpdr::vision {
namespace {

// A first view this far off both corridors is named after the one with more support.
constexpr double kHalfwayRad = 0.6;

double sigma_along(const Eigen::Matrix3d& covariance, const Eigen::Vector3d& axis) {
  return std::sqrt(std::max(0.0, axis.dot(covariance * axis)));
}

const cv::Mat& to_grey(const cv::Mat& image, cv::Mat& buffer) {
  if (image.channels() == 1) return image;
  cv::cvtColor(image, buffer, image.channels() == 3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
  return buffer;
}

}  // namespace

VanishingPointHeading::VanishingPointHeading(const VisionConfig& config, const CameraModel& camera)
    : config_(config),
      camera_(camera),
      detector_(config.lines),
      search_(config.search),
      tracker_(config.tracker) {}

VisionOutput VanishingPointHeading::process(const cv::Mat& image, TimestampNs stamp_ns,
                                            const std::optional<AttitudePrior>& prior) {
  VisionOutput out;
  out.heading.stamp_ns = stamp_ns;
  if (last_stamp_ns_ && stamp_ns <= *last_stamp_ns_) {
    out.outcome = FrameOutcome::kNotLater;
  } else {
    last_stamp_ns_ = stamp_ns;
    tracker_.predict(prior ? prior->turn : std::nullopt);
    const CameraParameters& p = camera_.parameters();
    out.outcome = check_frame(image, p.width_px, p.height_px, config_.frame_check);
    if (out.outcome == FrameOutcome::kFound) {
      try {
        out.outcome = look(image, prior, out);
      } catch (const cv::Exception&) {
        out.outcome = FrameOutcome::kLibraryFault;
      }
    }
  }
  out.heading.found = out.outcome == FrameOutcome::kFound;
  ++counts_[static_cast<std::size_t>(out.outcome)];
  return out;
}

FrameOutcome VanishingPointHeading::look(const cv::Mat& image,
                                         const std::optional<AttitudePrior>& prior,
                                         VisionOutput& out) {
  segments_ = &detector_.detect(to_grey(image, grey_));
  lift_to_sphere(*segments_, camera_, std::hypot(image.cols, image.rows),
                 config_.lines.endpoint_sigma_px, lifted_);
  out.segments = lifted_.size();
  if (lifted_.size() < static_cast<std::size_t>(config_.min_inliers)) {
    return FrameOutcome::kFewLines;
  }
  out.frame = search_.search(lifted_, vertical_of(prior), last_up_);
  if (!out.frame) return FrameOutcome::kNoCorridor;
  const ManhattanFrame& frame = *out.frame;
  const double noise = std::hypot(
      config_.noise_floor_rad,
      config_.sigma_factor * sigma_along(frame.covariance_rad2, frame.camera_from_corridor.col(2)));
  const double sigma = std::hypot(config_.sigma_floor_rad, noise);
  const FrameOutcome verdict = judge(frame, sigma);
  if (verdict != FrameOutcome::kFound) return verdict;
  last_up_ = frame.camera_from_corridor.col(2);
  const std::optional<ViewAngles> angles = angles_of(frame);
  if (!angles) return FrameOutcome::kUncertain;
  const CorridorTracker::Followed followed =
      tracker_.follow({out.heading.stamp_ns, angles->heading_rad, noise});
  out.heading.heading_rad = followed.heading_rad;
  out.heading.pitch_rad = angles->pitch_rad;
  out.heading.sigma_rad = sigma;
  out.heading.inliers = frame.inliers[0] + frame.inliers[1];
  out.rate = followed.rate;
  return followed.outcome;
}

FrameOutcome VanishingPointHeading::judge(const ManhattanFrame& frame, double sigma_rad) const {
  const auto inliers = static_cast<int>(frame.inliers[0] + frame.inliers[1]);
  const double horizontal = frame.support[0] + frame.support[1];
  const double explained = horizontal + frame.support[2];
  if (inliers < config_.min_inliers || horizontal < config_.min_support ||
      explained < config_.min_explained * (explained + frame.unexplained) ||
      frame.contrast < config_.min_contrast) {
    return FrameOutcome::kNoCorridor;
  }
  return sigma_rad > config_.max_sigma_rad ? FrameOutcome::kUncertain : FrameOutcome::kFound;
}

std::optional<ViewAngles> VanishingPointHeading::angles_of(const ManhattanFrame& frame) const {
  if (config_.angle_form == AngleForm::kUnitRay) {
    return level_view_angles(frame.camera_from_corridor);
  }
  const CameraParameters& p = camera_.parameters();
  const auto pixel = camera_.undistorted_pixel(frame.camera_from_corridor.col(0));
  if (!pixel) return std::nullopt;
  return printed_view_angles(*pixel, {p.cx_px, p.cy_px}, {p.fx_px, p.fy_px});
}

std::optional<VerticalPrior> VanishingPointHeading::vertical_of(
    const std::optional<AttitudePrior>& prior) const {
  if (!prior) return std::nullopt;
  const Eigen::Vector3d up_body = prior->world_from_body.conjugate() * Eigen::Vector3d::UnitZ();
  return VerticalPrior{camera_.parameters().body_from_camera.transpose() * up_body,
                       prior->inclination_sigma_rad};
}

}  // namespace vpdr::vision
