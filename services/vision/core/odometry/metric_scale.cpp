#include "vision/core/odometry/metric_scale.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace vpdr::vision {
namespace {

constexpr std::size_t kPathLength = 512;  // frames: ten seconds at 50 a second
constexpr std::size_t kStepsKept = 24;    // more than are taken while one waits
constexpr double kLeastPath = 1e-6;       // units, of a few steps: less is no walk
constexpr double kLeastWeight = 0.05;     // points further from the way are walls
constexpr double kAgreeingShare = 0.4;    // of the points on the way that must agree on a height
constexpr double kWayTimeS = 0.4;         // the way ahead is that of the last moments
constexpr double kLeastWayM = 0.1;        // in which the camera must have moved

}  // namespace

void MetricScale::restart() {
  known_ = false;
  refused_in_a_row_ = 0;
  path_count_ = 0;
}

void MetricScale::wander(double length) {
  variance_ += config_.wander_share * config_.wander_share * length * metres().value_or(1.0);
}

std::optional<double> MetricScale::metres() const {
  if (!known_) return std::nullopt;
  return std::exp(log_metres_);
}

double MetricScale::sigma_share() const { return std::sqrt(variance_); }

bool MetricScale::measure(double log_metres, double sigma) {
  const double noise = sigma * sigma;
  const double off = log_metres - log_metres_;
  if (known_ && off * off > config_.gate * config_.gate * (variance_ + noise)) {
    ++refused_;
    if (++refused_in_a_row_ < config_.refusals_to_restart) return false;
    known_ = false;
  }
  refused_in_a_row_ = 0;
  const double gain = known_ ? variance_ / (variance_ + noise) : 1.0;
  log_metres_ = known_ ? log_metres_ + gain * off : log_metres;
  variance_ = known_ ? (1.0 - gain) * variance_ : noise;
  known_ = true;
  return true;
}

void MetricScale::look(const std::vector<Landmark>& landmarks, const FeatureTracks& frame,
                       const CameraPose& pose, const Eigen::Vector3d& up, double up_sigma_rad) {
  if (!(config_.camera_height_m > 0.0)) return;
  const auto floor = floor_height(landmarks, frame, pose, up, up_sigma_rad);
  if (!floor) return;
  const double sigma =
      std::hypot(config_.height_share, floor->sigma_share, config_.measurement_share);
  if (measure(std::log(config_.camera_height_m / floor->height), sigma)) {
    ++floor_looks_;
    last_floor_ns_ = frame.stamp_ns;
  }
}

// Walls, skirting boards and things stand at all heights; what lies on the walker's own way is
// floor. Of the points below the camera those near that way count, and of their heights the one
// with the most within a few percent: reflections lie deeper, and differ.
std::optional<FloorHeight> MetricScale::floor_height(const std::vector<Landmark>& landmarks,
                                                     const FeatureTracks& frame,
                                                     const CameraPose& pose,
                                                     const Eigen::Vector3d& up,
                                                     double up_sigma_rad) {
  gather_below(landmarks, frame, pose, up, up_sigma_rad);
  return fit_floor(usual_log_height(), up_sigma_rad);
}

void MetricScale::gather_below(const std::vector<Landmark>& landmarks, const FeatureTracks& frame,
                               const CameraPose& pose, const Eigen::Vector3d& up,
                               double up_sigma_rad) {
  below_.clear();
  const Eigen::Vector3d side = up.cross(way_ahead(pose)).normalized();
  const Eigen::Vector3d ahead = side.cross(up);
  for (const Landmark& l : landmarks) {
    if (l.misses > 0 || l.relative_sigma() > config_.most_sigma_share || !frame.find(l.id))
      continue;
    const Eigen::Vector3d offset = l.position() - pose.position;
    const double height = -offset.dot(up);
    const double sine = height / offset.norm();
    if (sine < std::sin(config_.least_down_rad)) continue;
    const double beside = offset.dot(side) / (height * config_.way_half_width);
    const double weight = std::exp(-0.5 * beside * beside);
    if (weight < kLeastWeight) continue;
    const double flatness = std::sqrt(std::max(0.0, 1.0 - sine * sine)) / sine;
    const double noise = std::hypot(l.relative_sigma(), config_.floor_share);
    below_.push_back({std::log(height), std::hypot(noise, up_sigma_rad * flatness), weight, noise,
                      offset.dot(ahead) / height});
  }
}

double MetricScale::usual_log_height() const {
  double best = 0.0;
  double mode = 0.0;
  for (const Below& candidate : below_) {
    double support = 0.0;
    for (const Below& b : below_) {
      const double off = (b.log_height - candidate.log_height) / b.sigma;
      support += b.weight * std::exp(-0.5 * off * off) / b.sigma;
    }
    if (support > best) {
      best = support;
      mode = candidate.log_height;
    }
  }
  return mode;
}

// A tilt of the vertical lifts the floor the more the further ahead it lies: height and tilt are
// sought together, the tilt with its own uncertainty.
std::optional<FloorHeight> MetricScale::fit_floor(double log_height, double up_sigma_rad) const {
  FloorHeight floor;
  double all = 0.0, agreeing = 0.0;
  Eigen::Matrix2d information =
      Eigen::Vector2d(0.0, 1.0 / (up_sigma_rad * up_sigma_rad)).asDiagonal();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Below& b : below_) {
    const double off = b.log_height - log_height;
    all += b.weight;
    if (std::abs(off) > 2.0 * b.sigma) continue;
    agreeing += b.weight;
    ++floor.points;
    const Eigen::Vector2d depends(1.0, b.ahead);
    const double trust = b.weight / (b.noise * b.noise);
    sum += trust * off * depends;
    information += trust * depends * depends.transpose();
  }
  if (agreeing < config_.min_floor_points || agreeing < kAgreeingShare * all) return std::nullopt;
  const Eigen::Matrix2d covariance = information.inverse();
  floor.height = std::exp(log_height + covariance.row(0).dot(sum));
  floor.sigma_share = std::sqrt(covariance(0, 0));
  return floor;
}

// Where the walker is heading: where the camera went lately, or where it looks.
Eigen::Vector3d MetricScale::way_ahead(const CameraPose& pose) const {
  const std::size_t kept = std::min(path_count_, kPathLength);
  if (kept > 1) {
    const Place& now = path_[(path_count_ - 1) % kPathLength];
    for (std::size_t age = 1; age < kept; ++age) {
      const Place& then = path_[(path_count_ - 1 - age) % kPathLength];
      if (to_seconds(now.stamp_ns - then.stamp_ns) < kWayTimeS) continue;
      Eigen::Vector3d way = now.position - then.position;
      if (way.norm() * metres().value_or(1.0) > kLeastWayM) return way;
      break;
    }
  }
  return pose.map_from_camera * Eigen::Vector3d::UnitZ();
}

void MetricScale::add(const StepEvent& step) {
  if (step.status != StepStatus::kConfirmed || !(step.length_m > 0.0)) return;
  if (!steps_.empty() && step.stamp_ns <= steps_.back().stamp_ns) return;
  if (steps_.size() >= kStepsKept) steps_.erase(steps_.begin());
  steps_.push_back(step);
  waiting_steps_ = std::min(waiting_steps_ + 1, steps_.size());
}

void MetricScale::follow(TimestampNs stamp_ns, const Eigen::Vector3d& position) {
  if (path_.size() < kPathLength) path_.resize(kPathLength);
  path_[path_count_++ % kPathLength] = {stamp_ns, position};
  while (waiting_steps_ > 0) {
    const std::size_t oldest = steps_.size() - waiting_steps_;
    if (to_seconds(stamp_ns - steps_[oldest].stamp_ns) < config_.step_wait_s) return;
    --waiting_steps_;
    compare_with_steps(oldest);
  }
}

std::optional<Eigen::Vector3d> MetricScale::position_at(TimestampNs stamp_ns) const {
  for (std::size_t age = 1; age < std::min(path_count_, kPathLength); ++age) {
    const Place& after = path_[(path_count_ - age) % kPathLength];
    const Place& before = path_[(path_count_ - age - 1) % kPathLength];
    if (before.stamp_ns > stamp_ns) continue;
    if (after.stamp_ns < stamp_ns || after.stamp_ns <= before.stamp_ns) return std::nullopt;
    const double share =
        to_seconds(stamp_ns - before.stamp_ns) / to_seconds(after.stamp_ns - before.stamp_ns);
    return before.position + share * (after.position - before.position);
  }
  return std::nullopt;
}

// The length of the last steps over the way of the camera during them.
void MetricScale::compare_with_steps(std::size_t newest) {
  const auto count = static_cast<std::size_t>(config_.steps);
  if (newest < count) return;
  const StepEvent& last = steps_[newest];
  if (last_floor_ns_ && to_seconds(last.stamp_ns - *last_floor_ns_) < config_.floor_patience_s) {
    return;
  }
  double walked = 0.0;
  double seen = 0.0;
  for (std::size_t i = newest; i > newest - count; --i) {
    const StepEvent& step = steps_[i];
    const StepEvent& before = steps_[i - 1];
    // Steps far apart are not of one walk.
    if (to_seconds(step.stamp_ns - before.stamp_ns) > 1.2) return;
    const auto here = position_at(step.stamp_ns);
    const auto there = position_at(before.stamp_ns);
    if (!here || !there) return;
    seen += (*here - *there).norm();
    walked += step.length_m;
  }
  if (seen < kLeastPath) return;
  if (measure(std::log(walked / seen), config_.step_share)) ++step_looks_;
}

}  // namespace vpdr::vision
