#include "vision/core/heading/line_segments.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace vpdr::vision {
namespace {

double length_of(const LineSegment& s) { return (s.end_px - s.start_px).norm(); }

}  // namespace

const std::vector<LineSegment>& LineDetector::detect(const cv::Mat& grey) {
  const double reduction =
      std::max(1.0, static_cast<double>(grey.cols) / std::max(1, config_.working_width_px));
  const cv::Mat* used = &grey;
  if (reduction > 1.0) {
    cv::resize(grey, reduced_, cv::Size(), 1.0 / reduction, 1.0 / reduction, cv::INTER_AREA);
    used = &reduced_;
  }
  const double min_length = config_.min_length_fraction * std::hypot(grey.cols, grey.rows);
  // Reduced pixels are wider: their centres move.
  const auto to_full = [&](const Eigen::Vector2d& p) {
    return ((p.array() + 0.5) * reduction - 0.5).matrix().eval();
  };
  segments_.clear();
  for (const LineSegment& found : lines_.detect(*used)) {
    const LineSegment s{to_full(found.start_px), to_full(found.end_px)};
    if (length_of(s) >= min_length) segments_.push_back(s);
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
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const LineSegment& s = segments[i];
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
    out.source = i;
    lifted.push_back(out);
  }
}

}  // namespace vpdr::vision
