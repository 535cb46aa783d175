#include "vision/core/heading/vanishing_point_heading.hpp"

#include <utility>

namespace vpdr::vision {

VanishingPointHeading::VanishingPointHeading(const VisionConfig& config, const CameraModel& camera)
    : config_(config), directions_(config.directions, camera), tracker_(config.tracker) {}

VisionOutput VanishingPointHeading::process(const cv::Mat& image, TimestampNs stamp_ns,
                                            const std::optional<AttitudePrior>& prior) {
  VisionOutput out;
  out.heading.stamp_ns = stamp_ns;
  if (last_stamp_ns_ && stamp_ns <= *last_stamp_ns_) {
    out.outcome = FrameOutcome::kNotLater;
  } else {
    last_stamp_ns_ = stamp_ns;
    tracker_.predict(prior ? prior->turn : std::nullopt);
    out.outcome = look(image, prior, out);
  }
  out.heading.found = out.outcome == FrameOutcome::kFound;
  ++counts_[static_cast<std::size_t>(out.outcome)];
  return out;
}

FrameOutcome VanishingPointHeading::look(const cv::Mat& image,
                                         const std::optional<AttitudePrior>& prior,
                                         VisionOutput& out) {
  const FrameOutcome fit = directions_.check(image);
  if (fit != FrameOutcome::kFound) return fit;
  const std::uint64_t fingerprint = fingerprint_of(image);
  if (std::exchange(last_fingerprint_, fingerprint) == fingerprint) return FrameOutcome::kRepeated;
  const DirectionsSeen seen = directions_.find(image, vertical_of(prior), last_up_);
  out.segments = seen.segments;
  out.frame = seen.frame;
  if (seen.outcome != FrameOutcome::kFound) return seen.outcome;
  const ManhattanFrame& frame = *seen.frame;
  last_up_ = frame.camera_from_corridor.col(2);
  const std::optional<ViewAngles> angles = angles_of(frame);
  if (!angles) return FrameOutcome::kUncertain;
  const CorridorTracker::Followed followed =
      tracker_.follow({out.heading.stamp_ns, angles->heading_rad, seen.heading_noise_rad});
  out.heading.heading_rad = followed.heading_rad;
  out.heading.pitch_rad = angles->pitch_rad;
  out.roll_rad = angles->roll_rad;
  out.heading.sigma_rad = seen.heading_sigma_rad;
  out.heading.inliers = frame.inliers[0] + frame.inliers[1];
  out.rate = followed.rate;
  return followed.outcome;
}

std::optional<ViewAngles> VanishingPointHeading::angles_of(const ManhattanFrame& frame) const {
  if (config_.angle_form == AngleForm::kUnitRay) {
    return level_view_angles(frame.camera_from_corridor);
  }
  if (config_.angle_form == AngleForm::kTriplet) {
    return triplet_view_angles(frame.camera_from_corridor);
  }
  const CameraParameters& p = camera().parameters();
  const auto pixel = camera().undistorted_pixel(frame.camera_from_corridor.col(0));
  if (!pixel) return std::nullopt;
  return printed_view_angles(*pixel, {p.cx_px, p.cy_px}, {p.fx_px, p.fy_px});
}

std::optional<VerticalPrior> VanishingPointHeading::vertical_of(
    const std::optional<AttitudePrior>& prior) const {
  if (!prior) return std::nullopt;
  const Eigen::Vector3d up_body = prior->world_from_body.conjugate() * Eigen::Vector3d::UnitZ();
  return VerticalPrior{camera().parameters().body_from_camera.transpose() * up_body,
                       prior->inclination_sigma_rad};
}

}  // namespace vpdr::vision
