#include "bench/odometry_figures.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "bench/vision_figures.hpp"
#include "core/rotation.hpp"

namespace vpdr::bench {
namespace {

namespace fs = std::filesystem;
using namespace vpdr::vision;  // NOLINT
using Eigen::Vector3d;

}  // namespace

pdr::PdrConfig AttitudesOf::worn(pdr::Carry carry) {
  pdr::PdrConfig config;
  config.carry = carry;
  return config;
}

std::optional<AttitudePrior> AttitudesOf::at(TimestampNs stamp_ns) {
  while (next_ < imu_.size() && !track_.is_due(stamp_ns)) {
    const ImuSample& sample = imu_[next_++];
    while (next_mag_ < mag_.size() && mag_[next_mag_].stamp_ns <= sample.stamp_ns) {
      pdr_.process(mag_[next_mag_++]);
    }
    if (pdr_.process(sample, out_) != Refusal::kNone) continue;
    if (out_.attitude) track_.add(*out_.attitude);
    if (out_.step) steps.push_back(*out_.step);
  }
  return track_.at(stamp_ns);
}

void MotionErrors::add(const MotionEstimate& motion, const TrueMotion& truth, double speed_mps,
                       std::ofstream* csv) {
  const Vector3d off = log_rotation((motion.rotation * truth.rotation.conjugate()).normalized());
  rotation_deg.push_back(to_degrees(off.norm()));
  rotation_nees.push_back(off.dot(motion.covariance.bottomRightCorner<3, 3>().inverse() * off) /
                          3.0);
  double direction = -1.0;
  if (speed_mps > 0.1 && motion.translation_m.norm() > 1e-9) {
    direction = to_degrees(std::acos(std::clamp(
        motion.translation_m.normalized().dot(truth.translation_m.normalized()), -1.0, 1.0)));
    direction_deg.push_back(direction);
    length_ratio.push_back(motion.translation_m.norm() / truth.translation_m.norm());
  }
  if (csv != nullptr) {
    *csv << motion.stamp_ns << "," << motion.metric << "," << motion.inliers << "," << speed_mps
         << "," << rotation_deg.back() << "," << direction << ","
         << motion.translation_m.norm() / truth.translation_m.norm() << "\n";
  }
}

void MotionErrors::print() const {
  std::printf("  rotation between frames deg: RMS %.3f, median %.3f, p99 %.3f (n %zu); NEES %.2f\n",
              rms(rotation_deg), quantile(rotation_deg, 0.5), quantile(rotation_deg, 0.99),
              rotation_deg.size(),
              std::accumulate(rotation_nees.begin(), rotation_nees.end(), 0.0) /
                  static_cast<double>(std::max<std::size_t>(1, rotation_nees.size())));
  std::printf("  direction of motion deg, above 0.1 m/s: median %.2f, p90 %.2f (n %zu)\n",
              quantile(direction_deg, 0.5), quantile(direction_deg, 0.9), direction_deg.size());
  std::printf("  length over true length: p10 %.3f, median %.3f, p90 %.3f\n",
              quantile(length_ratio, 0.1), quantile(length_ratio, 0.5),
              quantile(length_ratio, 0.9));
}

OdometryOutput OdometryTimes::operator()(VisualOdometry& odometry, const OdometryInput& input) {
  const double start = cpu_ms();
  OdometryOutput out = odometry.process(input);
  const double end = cpu_ms();
  ms.push_back(end - start);
  // The calls of the front-end alone, corners over the whole image each time.
  static const cv::Ptr<cv::CLAHE> kClahe = cv::createCLAHE(3.0, {8, 8});
  const double bare = cpu_ms();
  cv::Mat even;
  kClahe->apply(input.grey, even);
  if (!last_.empty() && !points_.empty()) {
    std::vector<cv::Point2f> to;
    std::vector<std::uint8_t> found;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(last_, even, points_, to, found, error, {21, 21}, 3);
  }
  cv::goodFeaturesToTrack(even, points_, 150, 0.01, 20);
  bare_ms.push_back(cpu_ms() - bare);
  last_ = even;
  return out;
}

void OdometryTimes::print() const {
  std::printf("  ms a frame: median %.2f, p99 %.2f; bare OpenCV calls %.2f; ratio %.2f\n",
              quantile(ms, 0.5), quantile(ms, 0.99), quantile(bare_ms, 0.5),
              quantile(ms, 0.5) / quantile(bare_ms, 0.5));
}

// Piece by piece along the way, in the axes of the piece's start: nothing needs to be aligned.
void DriftErrors::add(const PoseEstimate& estimate, const Eigen::Isometry3d& truth) {
  Place place;
  place.truth = truth;
  place.estimate.linear() = estimate.world_from_body.toRotationMatrix();
  place.estimate.translation() = estimate.position_m;
  if (!places_.empty()) {
    place.way_m =
        places_.back().way_m + (truth.translation() - places_.back().truth.translation()).norm();
  }
  places_.push_back(place);
}

void DriftErrors::print() const {
  if (places_.size() < 2) {
    std::printf("  no odometry\n");
    return;
  }
  for (const double length : {5.0, 20.0}) {
    std::vector<double> drift, turn;
    for (std::size_t i = 0, j = 0; i < places_.size(); i += 5) {
      while (j < places_.size() && places_[j].way_m < places_[i].way_m + length) ++j;
      if (j == places_.size()) break;
      const Eigen::Isometry3d seen = places_[i].estimate.inverse() * places_[j].estimate;
      const Eigen::Isometry3d truth = places_[i].truth.inverse() * places_[j].truth;
      drift.push_back(100.0 * (seen.translation() - truth.translation()).norm() / length);
      turn.push_back(
          to_degrees(Eigen::AngleAxisd(seen.linear() * truth.linear().transpose()).angle()));
    }
    if (drift.empty()) continue;
    std::printf(
        "  drift over %.0f m: median %.2f %%, p90 %.2f %% of the way; turn median %.2f deg "
        "(n %zu)\n",
        length, quantile(drift, 0.5), quantile(drift, 0.9), quantile(turn, 0.5), drift.size());
  }
  const Eigen::Isometry3d seen = places_.front().estimate.inverse() * places_.back().estimate;
  const Eigen::Isometry3d truth = places_.front().truth.inverse() * places_.back().truth;
  const double off = (seen.translation() - truth.translation()).norm();
  std::printf("  end of the way of %.1f m: off by %.2f m, %.2f %%\n", places_.back().way_m, off,
              100.0 * off / places_.back().way_m);
}

void print_outcomes(const VisualOdometry& odometry) {
  std::printf("  outcomes:");
  for (std::size_t i = 0; i < kMotionOutcomeCount; ++i) {
    const auto outcome = static_cast<MotionOutcome>(i);
    if (odometry.count(outcome) > 0) {
      std::printf(" %s %lu", name_of(outcome), odometry.count(outcome));
    }
  }
  std::printf("\n");
}

// ------------------------------------------------------------------------------- depth

namespace {

cv::Mat depth_of(const fs::path& folder, const fs::path& image) {
  const fs::path file = folder / (image.stem().string() + ".png");
  return fs::exists(file) ? cv::imread(file, cv::IMREAD_UNCHANGED) : cv::Mat();
}

std::optional<Vector3d> point_at(const cv::Mat& depth, const CameraModel& camera,
                                 const Eigen::Vector2d& pixel) {
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  if (x < 1 || y < 1 || x >= depth.cols - 1 || y >= depth.rows - 1) return std::nullopt;
  int least = 1 << 16, most = 0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      const int z = depth.at<std::uint16_t>(y + dy, x + dx);
      least = std::min(least, z);
      most = std::max(most, z);
    }
  }
  // Edges of things have two depths.
  if (least < 400 || most > 6000 || most - least > 0.05 * most) return std::nullopt;
  const Vector3d ray = camera.ray(pixel);
  return ray * (1e-3 * depth.at<std::uint16_t>(y, x) / ray.z());
}

}  // namespace

FloorSeen floor_from_depth(const fs::path& folder, const CameraModel& camera,
                           const std::vector<fs::path>& images, int frames) {
  std::vector<double> heights;
  for (const fs::path& image : images) {
    const cv::Mat depth = depth_of(folder, image);
    if (depth.empty()) continue;
    std::vector<Vector3d> points;
    for (int y = depth.rows * 6 / 10; y < depth.rows; y += 6) {
      for (int x = 0; x < depth.cols; x += 6) {
        const auto point = point_at(depth, camera, {x, y});
        if (point && point->z() < 4.0) points.push_back(*point);
      }
    }
    if (points.size() < 100) continue;
    std::size_t best = 0;
    double height = 0.0;
    std::uint64_t state = 88172645463325252ULL;
    const auto draw = [&] {
      state ^= state << 13;
      state ^= state >> 7;
      state ^= state << 17;
      return state % points.size();
    };
    for (int i = 0; i < 500; ++i) {
      const Vector3d a = points[draw()], b = points[draw()], c = points[draw()];
      const Vector3d normal = (b - a).cross(c - a).normalized();
      if (!(std::abs(normal.y()) > 0.85)) continue;
      std::size_t on = 0;
      for (const Vector3d& p : points) on += std::abs(normal.dot(p - a)) < 0.015 ? 1 : 0;
      if (on > best) {
        best = on;
        height = std::abs(normal.dot(a));
      }
    }
    heights.push_back(height);
    if (static_cast<int>(heights.size()) == frames) break;
  }
  return {quantile(heights, 0.5), static_cast<int>(heights.size())};
}

std::optional<double> DepthReference::follow(const fs::path& image, const FeatureTracks& tracks) {
  const cv::Mat depth = depth_of(folder_, image);
  if (depth.empty()) return std::nullopt;
  std::optional<double> moved;
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> seen;
  for_each_match(last_, tracks, [&](const TrackedFeature& a, const TrackedFeature& b) {
    const auto point = point_at(last_depth_, camera_, a.pixel);
    if (!point) return;
    points.emplace_back(point->x(), point->y(), point->z());
    seen.emplace_back(b.ray.x() / b.ray.z(), b.ray.y() / b.ray.z());
  });
  if (points.size() >= 12) {
    cv::Mat rotation, translation, inliers;
    const cv::Mat ideal = cv::Mat::eye(3, 3, CV_64F);
    if (cv::solvePnPRansac(points, seen, ideal, cv::noArray(), rotation, translation, false, 500,
                           1.5F / 538.0F, 0.999, inliers) &&
        inliers.rows >= 10 && 2 * inliers.rows >= static_cast<int>(points.size())) {
      moved = cv::norm(translation);
    }
  }
  last_ = tracks;
  last_depth_ = depth;
  return moved.value_or(0.0);
}

void ScaleErrors::add(const OdometryOutput& out, const std::optional<double>& truth_m) {
  if (out.motion && out.motion->metric) {
    Eigen::Isometry3d step = Eigen::Isometry3d::Identity();
    step.linear() = out.motion->rotation.toRotationMatrix();
    step.translation() = out.motion->translation_m;
    since_ = since_ * step;
  } else {
    whole_ = false;
  }
  if (!truth_m) return;
  // Nobody walks faster: points of poor depth have misled PnP.
  constexpr double kMostM = 1.5;
  if (whole_ && *truth_m > 0.05 && *truth_m < kMostM) {
    seen_m_.push_back(since_.translation().norm());
    true_m_.push_back(*truth_m);
  }
  since_.setIdentity();
  whole_ = true;
}

void ScaleErrors::print() const {
  std::vector<double> ratio;
  for (std::size_t i = 0; i < seen_m_.size(); ++i) ratio.push_back(seen_m_[i] / true_m_[i]);
  const double seen = std::accumulate(seen_m_.begin(), seen_m_.end(), 0.0);
  const double truth = std::accumulate(true_m_.begin(), true_m_.end(), 0.0);
  std::printf(
      "  length against depth: %.2f of %.2f m, ratio %.3f; pieces p10 %.3f median %.3f p90 "
      "%.3f (n %zu)\n",
      seen, truth, seen / truth, quantile(ratio, 0.1), quantile(ratio, 0.5), quantile(ratio, 0.9),
      ratio.size());
}

}  // namespace vpdr::bench
