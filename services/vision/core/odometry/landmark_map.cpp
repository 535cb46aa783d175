#include "vision/core/odometry/landmark_map.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "vision/core/across.hpp"

namespace vpdr::vision {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kPoseSteps = 8;
constexpr double kPoseEnd = 1e-6;
constexpr double kLeastShare = 1e-3;  // of the typical inverse distance: beyond, a direction

// Squared error of a sighting in sigmas, given its inverse covariance.
double squared(const Vector2d& error, const Matrix2d& information) {
  return error.dot(information * error);
}

Matrix2d information_of(const Sighting& s, double variance, double ray_sigma) {
  const Matrix2d covariance = ray_sigma * ray_sigma * Matrix2d::Identity() +
                              variance * s.by_inverse_distance * s.by_inverse_distance.transpose();
  return covariance.inverse();
}

}  // namespace

double Landmark::relative_sigma() const { return std::sqrt(variance) / inverse_distance; }

Sighting sight(const Landmark& landmark, const Vector3d& ray, const CameraPose& pose) {
  const Eigen::Matrix3d camera_from_map = pose.map_from_camera.conjugate().toRotationMatrix();
  const Vector3d offset = landmark.anchor - pose.position;
  const Vector3d point = camera_from_map * (landmark.inverse_distance * offset + landmark.bearing);
  const double length = point.norm();
  Sighting s;
  s.ahead = length > 1e-9 && point.dot(ray) > 0.0;
  if (!s.ahead) return s;
  const Vector3d unit = point / length;
  const Eigen::Matrix<double, 3, 2> basis = across(ray);
  const Eigen::Matrix<double, 2, 3> project =
      basis.transpose() * (Eigen::Matrix3d::Identity() - unit * unit.transpose()) / length;
  s.error = basis.transpose() * unit;
  s.by_pose.leftCols<3>() = -landmark.inverse_distance * project * camera_from_map;
  s.by_pose.rightCols<3>() = project * skew(point);
  s.by_inverse_distance = project * (camera_from_map * offset);
  return s;
}

double LandmarkMap::typical_inverse_distance() {
  values_.clear();
  for (const Landmark& l : landmarks_) {
    if (l.relative_sigma() < 0.3) values_.push_back(l.inverse_distance);
  }
  if (values_.empty()) return 0.0;
  const auto middle = values_.begin() + static_cast<std::ptrdiff_t>(values_.size() / 2);
  std::nth_element(values_.begin(), middle, values_.end());
  return *middle;
}

void LandmarkMap::update(const FeatureTracks& frame, const CameraPose& pose, double ray_sigma_rad,
                         double position_sigma) {
  const double typical = typical_inverse_distance();
  next_.clear();
  for_each_sighted(landmarks_, frame, [&](const TrackedFeature& f, const Landmark* known) {
    Landmark landmark;
    if (known != nullptr) {
      landmark = *known;
      narrow(landmark, f, pose, ray_sigma_rad, position_sigma);
      landmark.inverse_distance = std::max(landmark.inverse_distance, kLeastShare * typical);
    }
    if (landmark.id == 0 || landmark.misses > config_.max_misses) {
      landmark = {f.id, pose.position, pose.map_from_camera * f.ray, typical, 0.0, 0};
      landmark.variance = std::pow(config_.unknown_share * typical, 2);
    }
    next_.push_back(landmark);
  });
  std::swap(landmarks_, next_);
}

void LandmarkMap::narrow(Landmark& landmark, const TrackedFeature& feature, const CameraPose& pose,
                         double ray_sigma_rad, double position_sigma) const {
  const Sighting s = sight(landmark, feature.ray, pose);
  const double noise = std::hypot(ray_sigma_rad, position_sigma * landmark.inverse_distance);
  if (!s.ahead ||
      squared(s.error, information_of(s, landmark.variance, noise)) > config_.gate * config_.gate) {
    ++landmark.misses;
    return;
  }
  landmark.misses = 0;
  const double told = s.by_inverse_distance.squaredNorm() / (noise * noise);
  const double information = 1.0 / landmark.variance + told;
  landmark.inverse_distance -= s.by_inverse_distance.dot(s.error) / (noise * noise) / information;
  landmark.variance =
      1.0 / information + std::pow(config_.drift_share * landmark.inverse_distance, 2);
}

namespace {

struct Normal {
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
};

void add_prior(const PosePrior& prior, const CameraPose& pose, Normal& normal) {
  const double by_position = 1.0 / (prior.position_sigma * prior.position_sigma);
  const double by_rotation = 1.0 / (prior.rotation_sigma_rad * prior.rotation_sigma_rad);
  normal.information.topLeftCorner<3, 3>() += by_position * Eigen::Matrix3d::Identity();
  normal.gradient.head<3>() += by_position * (pose.position - prior.pose.position);
  normal.information.bottomRightCorner<3, 3>() += by_rotation * Eigen::Matrix3d::Identity();
  normal.gradient.tail<3>() +=
      by_rotation *
      log_rotation((prior.pose.map_from_camera.conjugate() * pose.map_from_camera).normalized());
}

}  // namespace

PoseFix fix_pose(const std::vector<Landmark>& landmarks, const FeatureTracks& frame,
                 const PosePrior& prior, double ray_sigma_rad) {
  PoseFix fix;
  fix.pose = prior.pose;
  Normal normal;
  double tolerance = 8.0;  // sigmas at which a sighting's weight is half; sharpened step by step
  for (int step = 0; step < kPoseSteps; ++step) {
    normal = {};
    fix.seen = fix.inliers = 0;
    for_each_sighted(landmarks, frame, [&](const TrackedFeature& f, const Landmark* l) {
      if (l == nullptr) return;
      ++fix.seen;
      if (l->misses > 0) return;
      const Sighting s = sight(*l, f.ray, fix.pose);
      if (!s.ahead) return;
      const Matrix2d information = information_of(s, l->variance, ray_sigma_rad);
      const double off = squared(s.error, information);
      fix.inliers += off < 9.0 ? 1 : 0;
      const double weight = 1.0 / (1.0 + off / (tolerance * tolerance));
      const Eigen::Matrix<double, 6, 2> told = weight * s.by_pose.transpose() * information;
      normal.information += told * s.by_pose;
      normal.gradient += told * s.error;
    });
    add_prior(prior, fix.pose, normal);
    const Eigen::Matrix<double, 6, 1> change = normal.information.ldlt().solve(-normal.gradient);
    if (!change.allFinite()) break;
    fix.pose.position += change.head<3>();
    fix.pose.map_from_camera =
        (fix.pose.map_from_camera * exp_rotation(change.tail<3>())).normalized();
    const bool sharp = tolerance <= 2.0;
    tolerance = std::max(2.0, 0.5 * tolerance);
    if (sharp && change.norm() < kPoseEnd) break;
  }
  fix.covariance = normal.information.inverse();
  return fix;
}

}  // namespace vpdr::vision
