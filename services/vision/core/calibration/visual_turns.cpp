#include "vision/core/calibration/visual_turns.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "core/rotation.hpp"

namespace vpdr::vision {
namespace {

using Points = std::vector<cv::Point2f>;
using Vector5d = Eigen::Matrix<double, 5, 1>;
using Matrix5d = Eigen::Matrix<double, 5, 5>;

constexpr double kQuality = 0.01;  // of a corner, against the best one
constexpr int kRefinements = 10;
constexpr double kStep = 1e-6;
constexpr double kDamping = 1e-3;  // of the direction, which a turn on the spot leaves free

struct Flow {
  Points from, to;
};

Flow follow(const cv::Mat& last, const cv::Mat& grey, const VisualTurnsConfig& config) {
  Points corners;
  cv::goodFeaturesToTrack(last, corners, config.max_corners, kQuality, config.min_distance_px);
  Flow flow;
  if (corners.empty()) return flow;
  Points there;
  Points back;
  std::vector<std::uint8_t> found;
  std::vector<std::uint8_t> found_back;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(last, grey, corners, there, found, error);
  cv::calcOpticalFlowPyrLK(grey, last, there, back, found_back, error);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (found[i] == 0 || found_back[i] == 0) continue;
    if (cv::norm(corners[i] - back[i]) > config.max_return_px) continue;
    flow.from.push_back(corners[i]);
    flow.to.push_back(there[i]);
  }
  return flow;
}

struct Rays {
  std::vector<Eigen::Vector3d> earlier, later;
};

Rays rays_of(const Flow& flow, const CameraModel& camera) {
  Rays rays;
  for (std::size_t i = 0; i < flow.from.size(); ++i) {
    const Eigen::Vector3d a = camera.ray({flow.from[i].x, flow.from[i].y});
    const Eigen::Vector3d b = camera.ray({flow.to[i].x, flow.to[i].y});
    if (a.z() < 0.1 || b.z() < 0.1) continue;
    rays.earlier.push_back(a);
    rays.later.push_back(b);
  }
  return rays;
}

std::vector<cv::Point2d> on_plane(const std::vector<Eigen::Vector3d>& rays) {
  std::vector<cv::Point2d> out;
  for (const Eigen::Vector3d& r : rays) out.emplace_back(r.x() / r.z(), r.y() / r.z());
  return out;
}

struct Motion {
  Eigen::Matrix3d later_from_earlier = Eigen::Matrix3d::Identity();
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
};

Motion moved(const Motion& m, const Vector5d& d) {
  const Eigen::Vector3d side = m.direction.unitOrthogonal();
  const Eigen::Vector3d other = m.direction.cross(side);
  return {exp_rotation(d.head<3>()).toRotationMatrix() * m.later_from_earlier,
          (m.direction + d[3] * side + d[4] * other).normalized()};
}

// Angle between the later ray and the epipolar plane of the earlier one.
double off_plane(const Motion& m, const Eigen::Vector3d& earlier, const Eigen::Vector3d& later) {
  const Eigen::Vector3d normal = m.direction.cross(m.later_from_earlier * earlier);
  return normal.dot(later) / std::max(normal.norm(), 1e-9);
}

// Gauss-Newton with Cauchy weights; the rays' noise is what the inlier limit allows.
void refine(const Rays& rays, double sigma_rad, Motion& m) {
  for (int i = 0; i < kRefinements; ++i) {
    Matrix5d information = Matrix5d::Zero();
    Vector5d gradient = Vector5d::Zero();
    for (std::size_t k = 0; k < rays.earlier.size(); ++k) {
      const double r = off_plane(m, rays.earlier[k], rays.later[k]);
      Vector5d jacobian;
      for (int j = 0; j < 5; ++j) {
        const Vector5d d = Vector5d::Unit(j) * kStep;
        jacobian[j] = (off_plane(moved(m, d), rays.earlier[k], rays.later[k]) - r) / kStep;
      }
      const double w = 1.0 / (1.0 + r * r / (sigma_rad * sigma_rad));
      information += w * jacobian * jacobian.transpose();
      gradient += w * r * jacobian;
    }
    information.diagonal().tail<2>().array() += kDamping;
    information.diagonal().head<3>().array() += 1e-9;
    const Vector5d step = -information.ldlt().solve(gradient);
    m = moved(m, step);
    if (step.head<3>().norm() < 1e-7) break;
  }
}

// Keeps the rays that agree.
std::optional<Motion> motion_of(Rays& rays, double inlier, std::size_t min_inliers) {
  if (rays.earlier.size() < min_inliers) return std::nullopt;
  const auto earlier = on_plane(rays.earlier);
  const auto later = on_plane(rays.later);
  cv::Mat mask;
  const cv::Mat identity = cv::Mat::eye(3, 3, CV_64F);
  const cv::Mat essential =
      cv::findEssentialMat(earlier, later, identity, cv::RANSAC, 0.999, inlier, mask);
  if (essential.rows != 3 || essential.cols != 3) return std::nullopt;
  cv::Mat rotation;
  cv::Mat translation;
  cv::Mat in_front = mask.clone();
  cv::recoverPose(essential, earlier, later, identity, rotation, translation, in_front);
  Rays kept;
  for (std::size_t i = 0; i < rays.earlier.size(); ++i) {
    if (mask.at<std::uint8_t>(static_cast<int>(i)) == 0) continue;
    kept.earlier.push_back(rays.earlier[i]);
    kept.later.push_back(rays.later[i]);
  }
  if (kept.earlier.size() < min_inliers) return std::nullopt;
  Motion m;
  cv::cv2eigen(rotation, m.later_from_earlier);
  m.direction = {translation.at<double>(0), translation.at<double>(1), translation.at<double>(2)};
  rays = std::move(kept);
  return m;
}

}  // namespace

VisualTurns::VisualTurns(const VisualTurnsConfig& config, const CameraModel& camera)
    : config_(config), camera_(camera) {}

std::optional<VisualTurn> VisualTurns::add(const cv::Mat& grey, TimestampNs stamp_ns) {
  if (grey.empty() || grey.type() != CV_8UC1) return std::nullopt;
  std::optional<VisualTurn> turn;
  const double interval = to_seconds(stamp_ns - last_ns_);
  if (!last_.empty() && last_.size() == grey.size() && interval > 0.0 &&
      interval <= config_.max_interval_s) {
    try {
      turn = turn_to(grey, stamp_ns);
    } catch (const cv::Exception&) {
      turn.reset();
    }
  }
  last_ = grey.clone();
  last_ns_ = stamp_ns;
  return turn;
}

std::optional<VisualTurn> VisualTurns::turn_to(const cv::Mat& grey, TimestampNs stamp_ns) {
  Rays rays = rays_of(follow(last_, grey, config_), camera_);
  const double inlier = config_.inlier_px / camera_.focal_px();
  std::optional<Motion> m = motion_of(rays, inlier, config_.min_inliers);
  if (!m) return std::nullopt;
  refine(rays, 0.3 * inlier, *m);
  VisualTurn turn;
  turn.start_ns = last_ns_;
  turn.end_ns = stamp_ns;
  turn.rotation_rad = log_rotation(Eigen::Quaterniond(m->later_from_earlier.transpose().eval()));
  return turn;
}

}  // namespace vpdr::vision
