#include "vision/core/odometry/map_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::vision {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kTypicalSceneM = 3.0;  // where the unit is not known: scenes indoors are so far

double median(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

MapTracker::MapTracker(const MapTrackerConfig& config)
    : config_(config), two_frames_(config.two_frames), map_(config.map) {}

void MapTracker::restart() {
  give_up();
  last_.features.clear();
  reference_.features.clear();
  since_reference_.reset();
}

void MapTracker::give_up() {
  state_ = MapState::kStarting;
  map_.clear();
  lost_ = 0;
}

// The wait for parallax begins at this frame; `turn`: whether a gyroscope goes with the frames.
void MapTracker::refer_to(const FeatureTracks& frame, const std::optional<RotationPrior>& turn) {
  reference_ = frame;
  since_reference_.reset();
  if (turn) since_reference_ = RotationPrior{Matrix3d::Identity(), 1e-6};
}

MapStep MapTracker::process(const FeatureTracks& frame, const std::optional<RotationPrior>& turn,
                            double ray_sigma_rad, std::optional<double> metres) {
  ray_sigma_rad_ = ray_sigma_rad;
  metres_ = metres;
  MapStep step = state_ == MapState::kStarting ? start(frame, turn) : track(frame, turn);
  last_ = frame;
  return step;
}

MapStep MapTracker::hold(const FeatureTracks& frame) {
  MapStep step;
  step.state = state_;
  step.held = true;
  step.previous = step.pose = pose_;
  step.covariance = 1e-8 * Matrix6d::Identity();
  step.inliers = frame.features.size();
  velocity_.setZero();
  turn_rate_.setZero();
  last_ = frame;
  if (state_ == MapState::kStarting) {
    reference_ = frame;
    since_reference_.reset();
  }
  return step;
}

void MapTracker::pair_up(const FeatureTracks& earlier, const FeatureTracks& later) {
  pairs_.clear();
  pair_ids_.clear();
  for_each_match(earlier, later, [&](const TrackedFeature& a, const TrackedFeature& b) {
    pairs_.push_back({a.ray, b.ray});
    pair_ids_.push_back(a.id);
  });
}

void MapTracker::expect(const FeatureTracks& before, TimestampNs stamp_ns,
                        const std::optional<RotationPrior>& turn,
                        std::vector<Eigen::Vector3d>& rays) {
  rays.clear();
  if (state_ != MapState::kTracking) {
    if (!turn) return;
    for (const TrackedFeature& f : before.features) {
      rays.push_back(turn->earlier_from_later.transpose() * f.ray);
    }
    return;
  }
  const CameraPose next = predict(to_seconds(stamp_ns - before.stamp_ns), turn).pose;
  const Matrix3d next_from_map = next.map_from_camera.conjugate().toRotationMatrix();
  const Matrix3d next_from_last = next_from_map * pose_.map_from_camera.toRotationMatrix();
  // Scaled by the inverse distance: of a point without a place in the map, the typical one.
  const Vector3d moved =
      map_.typical_inverse_distance() * (next_from_map * (pose_.position - next.position));
  for_each_sighted(map_.landmarks(), before, [&](const TrackedFeature& f, const Landmark* l) {
    rays.push_back(l != nullptr
                       ? Vector3d(next_from_map *
                                  (l->inverse_distance * (l->anchor - next.position) + l->bearing))
                       : Vector3d(next_from_last * f.ray + moved));
  });
}

// ------------------------------------------------------------------------------- starting

MapStep MapTracker::start(const FeatureTracks& frame, const std::optional<RotationPrior>& turn) {
  MapStep step;
  if (!last_.features.empty()) {
    pair_up(last_, frame);
    step.two_frames = two_frames_.estimate(pairs_, ray_sigma_rad_, turn);
    step.inliers = step.two_frames->inliers;
  }
  if (turn && since_reference_) {
    since_reference_->earlier_from_later *= turn->earlier_from_later;
    since_reference_->sigma_rad = since_reference_->sigma_rad + turn->sigma_rad;
  } else {
    since_reference_.reset();
  }
  pair_up(reference_, frame);
  if (pairs_.size() < config_.start_points) {
    refer_to(frame, turn);
    step.new_reference = true;
    return step;
  }
  const RelativeMotion motion = two_frames_.estimate(pairs_, ray_sigma_rad_, since_reference_);
  const bool moved =
      motion.model == MotionModel::kEssential || motion.model == MotionModel::kHomography;
  if (!moved || motion.parallax_rad < config_.start_parallax_rad ||
      motion.inliers < config_.start_points || !begin_map(frame, motion)) {
    return step;
  }
  step.state = state_;
  step.new_map = step.key_frame = true;
  step.start_ns = reference_.stamp_ns;
  step.pose = pose_;
  step.covariance.topLeftCorner<3, 3>() = motion.covariance.bottomRightCorner<3, 3>();
  step.covariance.bottomRightCorner<3, 3>() = motion.covariance.topLeftCorner<3, 3>();
  return step;
}

// The map's unit is the way between its first two frames; its axes are the first one's.
bool MapTracker::begin_map(const FeatureTracks& frame, const RelativeMotion& motion) {
  map_.clear();
  std::size_t good = 0;
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const Vector3d later = motion.earlier_from_later * pairs_[i].later;
    const Vector3d normal = pairs_[i].earlier.cross(later);
    const Vector3d lever = motion.direction.cross(later);
    Landmark landmark;
    landmark.id = pair_ids_[i];
    landmark.bearing = pairs_[i].earlier;
    // Where the two rays meet: distance = lever . normal / normal . normal.
    const double along = lever.dot(normal);
    const double noise = 2.0 * ray_sigma_rad_ * ray_sigma_rad_;
    landmark.variance = noise / std::max(lever.squaredNorm(), noise);
    landmark.inverse_distance = along > 0.0 ? normal.squaredNorm() / along : 0.0;
    const bool behind = along < 0.0 && normal.squaredNorm() > 9.0 * noise;
    if (behind || landmark.inverse_distance > 10.0) continue;
    landmark.inverse_distance = std::max(landmark.inverse_distance, 1e-4);
    good += landmark.relative_sigma() < 0.5 ? 1 : 0;
    map_.add(landmark);
  }
  if (good < config_.start_points / 2) {
    map_.clear();
    return false;
  }
  const double dt = std::max(1e-3, to_seconds(frame.stamp_ns - reference_.stamp_ns));
  pose_ = {motion.direction, Eigen::Quaterniond(motion.earlier_from_later).normalized()};
  velocity_ = motion.direction / dt;
  turn_rate_.setZero();
  state_ = MapState::kTracking;
  lost_ = 0;
  map_.update(frame, pose_, ray_sigma_rad_, 0.0);
  remember(frame, pose_);
  return true;
}

// ------------------------------------------------------------------------------- tracking

PosePrior MapTracker::predict(double dt_s, const std::optional<RotationPrior>& turn) {
  PosePrior prior;
  prior.pose.position = pose_.position + velocity_ * dt_s;
  const double metres =
      metres_.value_or(kTypicalSceneM * std::max(1e-6, map_.typical_inverse_distance()));
  prior.position_sigma = config_.most_acceleration_mps2 * dt_s * dt_s / metres;
  const Eigen::Quaterniond turned = turn ? Eigen::Quaterniond(turn->earlier_from_later).normalized()
                                         : exp_rotation(turn_rate_ * dt_s);
  prior.pose.map_from_camera = (pose_.map_from_camera * turned).normalized();
  prior.rotation_sigma_rad = turn ? turn->sigma_rad : config_.turn_sigma_rad;
  return prior;
}

MapStep MapTracker::track(const FeatureTracks& frame, const std::optional<RotationPrior>& turn) {
  const double dt = to_seconds(frame.stamp_ns - last_.stamp_ns);
  const PosePrior prior = predict(dt, turn);
  const PoseFix fix = fix_pose(map_.landmarks(), frame, prior, ray_sigma_rad_);
  const bool believed =
      fix.inliers >= config_.least_points &&
      static_cast<double>(fix.inliers) >= config_.least_share * static_cast<double>(fix.seen);
  if (!believed) pair_up(last_, frame);
  if (!believed && pairs_.size() >= config_.start_points) {
    // The two frames still tell the motion where the map does not.
    give_up();
    refer_to(last_, turn);
    return start(frame, turn);
  }
  MapStep step;
  step.previous = pose_;
  step.inliers = fix.inliers;
  if (believed) {
    lost_ = 0;
    step.pose = fix.pose;
    step.covariance = fix.covariance;
  } else {
    step.pose = prior.pose;
    step.covariance.diagonal() << Vector3d::Constant(prior.position_sigma * prior.position_sigma),
        Vector3d::Constant(prior.rotation_sigma_rad * prior.rotation_sigma_rad);
    if (++lost_ > config_.lost_frames) {
      give_up();
      refer_to(frame, turn);
      step.new_reference = true;
      return step;
    }
  }
  state_ = step.state = believed ? MapState::kTracking : MapState::kBridging;
  velocity_ = (step.pose.position - pose_.position) / dt;
  turn_rate_ =
      log_rotation((pose_.map_from_camera.conjugate() * step.pose.map_from_camera).normalized()) /
      dt;
  pose_ = step.pose;
  if (believed && is_key_frame(frame, pose_)) {
    step.key_frame = true;
    map_.update(frame, pose_, ray_sigma_rad_,
                std::sqrt(fix.covariance.topLeftCorner<3, 3>().trace() / 3.0));
    remember(frame, pose_);
  }
  return step;
}

bool MapTracker::is_key_frame(const FeatureTracks& frame, const CameraPose& pose) {
  const Eigen::Matrix3d key_from_now =
      (key_pose_.map_from_camera.conjugate() * pose.map_from_camera).toRotationMatrix();
  values_.clear();
  for_each_match(key_, frame, [&](const TrackedFeature& a, const TrackedFeature& b) {
    values_.push_back((a.ray - key_from_now * b.ray).norm());
  });
  const double share = static_cast<double>(values_.size()) /
                       std::max<double>(1.0, static_cast<double>(frame.features.size()));
  return share < config_.key_share || median(values_) > config_.key_parallax_rad;
}

void MapTracker::remember(const FeatureTracks& frame, const CameraPose& pose) {
  key_ = frame;
  key_pose_ = pose;
}

}  // namespace vpdr::vision
