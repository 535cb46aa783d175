#include "vision/core/heading/building_directions.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace vpdr::vision {
namespace {

const cv::Mat& to_grey(const cv::Mat& image, cv::Mat& buffer) {
  if (image.channels() == 1) return image;
  cv::cvtColor(image, buffer, image.channels() == 3 ? cv::COLOR_BGR2GRAY : cv::COLOR_BGRA2GRAY);
  return buffer;
}

}  // namespace

BuildingDirections::BuildingDirections(const DirectionsConfig& config, const CameraModel& camera)
    : config_(config), camera_(camera), detector_(config.lines), search_(config.search) {}

DirectionsSeen BuildingDirections::look(const cv::Mat& image,
                                        const std::optional<VerticalPrior>& vertical,
                                        const Eigen::Vector3d& usual_up) {
  const FrameOutcome fit = check(image);
  if (fit == FrameOutcome::kFound) return find(image, vertical, usual_up);
  DirectionsSeen seen;
  seen.outcome = fit;
  return seen;
}

FrameOutcome BuildingDirections::check(const cv::Mat& image) const {
  const CameraParameters& p = camera_.parameters();
  return check_frame(image, p.width_px, p.height_px, config_.frame_check);
}

DirectionsSeen BuildingDirections::find(const cv::Mat& image,
                                        const std::optional<VerticalPrior>& vertical,
                                        const Eigen::Vector3d& usual_up) {
  DirectionsSeen seen;
  try {
    search(image, vertical, usual_up, seen);
  } catch (const cv::Exception&) {
    seen.outcome = FrameOutcome::kLibraryFault;
  }
  return seen;
}

void BuildingDirections::search(const cv::Mat& image, const std::optional<VerticalPrior>& vertical,
                                const Eigen::Vector3d& usual_up, DirectionsSeen& seen) {
  segments_ = &detector_.detect(to_grey(image, grey_));
  lift_to_sphere(*segments_, camera_, std::hypot(image.cols, image.rows),
                 config_.lines.endpoint_sigma_px, lifted_);
  seen.segments = lifted_.size();
  seen.outcome = FrameOutcome::kFewLines;
  if (lifted_.size() < static_cast<std::size_t>(config_.min_inliers)) return;
  seen.frame = search_.search(lifted_, vertical, usual_up);
  seen.outcome = FrameOutcome::kNoCorridor;
  if (!seen.frame) return;
  add_uncertainty(seen);
  seen.outcome = judge(*seen.frame, seen.heading_sigma_rad);
}

void BuildingDirections::add_uncertainty(DirectionsSeen& seen) const {
  const Eigen::Matrix3d& covariance = seen.frame->covariance_rad2;
  const auto along = [&](int i) {
    const Eigen::Vector3d axis = seen.frame->camera_from_corridor.col(i);
    return std::max(0.0, axis.dot(covariance * axis));
  };
  const auto with_floor = [&](double floor, double variance) {
    return std::hypot(floor, config_.sigma_factor * std::sqrt(std::max(0.0, variance)));
  };
  seen.heading_noise_rad = with_floor(config_.noise_floor_rad, along(2));
  seen.heading_sigma_rad = std::hypot(config_.sigma_floor_rad, seen.heading_noise_rad);
  const auto free = free_directions(lifted_, seen.frame->camera_from_corridor,
                                    config_.search.refine, config_.free);
  for (std::size_t i = 0; i < 3; ++i) {
    seen.directions[i] = free[i].direction;
    seen.sigma_rad[i] = with_floor(config_.sigma_floor_rad, free[i].variance_rad2);
  }
}

FrameOutcome BuildingDirections::judge(const ManhattanFrame& frame, double sigma_rad) const {
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

}  // namespace vpdr::vision
