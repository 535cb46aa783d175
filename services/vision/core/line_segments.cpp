#include "vision/core/line_segments.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace vpdr::vision {
namespace {

// LSD's own defaults, except for the scale.
constexpr double kSigmaScale = 0.6;
constexpr double kQuantisation = 2.0;
constexpr double kAngleToleranceDeg = 22.5;
constexpr double kLogEpsilon = 0.0;
constexpr double kDensity = 0.7;
constexpr int kBins = 1024;

double length_of(const LineSegment& s) { return (s.end_px - s.start_px).norm(); }

}  // namespace

LineDetector::LineDetector(const LineConfig& config)
    : config_(config),
      detector_(cv::createLineSegmentDetector(cv::LSD_REFINE_STD, config.detector_scale,
                                              kSigmaScale, kQuantisation, kAngleToleranceDeg,
                                              kLogEpsilon, kDensity, kBins)) {}

const std::vector<LineSegment>& LineDetector::detect(const cv::Mat& grey) {
  const double reduction =
      std::max(1.0, static_cast<double>(grey.cols) / std::max(1, config_.working_width_px));
  if (reduction > 1.0) {
    cv::resize(grey, reduced_, cv::Size(), 1.0 / reduction, 1.0 / reduction, cv::INTER_AREA);
    detector_->detect(reduced_, raw_);
  } else {
    detector_->detect(grey, raw_);
  }
  // Reduced pixels are wider: their centres move. LSD itself divides by its scale only.
  const double inner = 0.5 / config_.detector_scale - 0.5;
  const auto to_full = [&](double v) { return (v + inner + 0.5) * reduction - 0.5; };
  const double diagonal = std::hypot(grey.cols, grey.rows);
  segments_.clear();
  for (const cv::Vec4f& r : raw_) {
    const LineSegment s{{to_full(r[0]), to_full(r[1])}, {to_full(r[2]), to_full(r[3])}};
    if (length_of(s) >= config_.min_length_fraction * diagonal) segments_.push_back(s);
  }
  std::stable_sort(
      segments_.begin(), segments_.end(),
      [](const LineSegment& a, const LineSegment& b) { return length_of(a) > length_of(b); });
  if (segments_.size() > static_cast<std::size_t>(config_.max_segments)) {
    segments_.resize(static_cast<std::size_t>(config_.max_segments));
  }
  return segments_;
}

void lift_to_sphere(const std::vector<LineSegment>& segments, const CameraModel& camera,
                    double diagonal_px, double endpoint_sigma_px,
                    std::vector<SphereSegment>& lifted) {
  lifted.clear();
  for (const LineSegment& s : segments) {
    const Eigen::Vector3d a = camera.ray(s.start_px);
    const Eigen::Vector3d b = camera.ray(s.end_px);
    const Eigen::Vector3d cross = a.cross(b);
    const double sine = cross.norm();
    if (!(sine > 1e-6)) continue;
    SphereSegment out;
    out.normal = cross / sine;
    out.middle = (a + b).normalized();
    out.along = out.normal.cross(out.middle);
    const double length_px = length_of(s);
    const double sigma_rad = endpoint_sigma_px * std::atan2(sine, a.dot(b)) / length_px;
    out.weight = length_px / diagonal_px;
    out.tilt_sigma_rad = std::sqrt(2.0) * endpoint_sigma_px / length_px;
    out.shift_sigma_rad = sigma_rad / std::sqrt(2.0);
    lifted.push_back(out);
  }
}

}  // namespace vpdr::vision
