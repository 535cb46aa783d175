#include "vision/core/odometry/relative_motion.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "vision/core/odometry/coplanarity.hpp"
#include "vision/core/odometry/plane_motion.hpp"

namespace vpdr::vision {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::uint64_t kSeed = 0x9e3779b97f4a7c15ULL;
constexpr int kFivePointSteps = 6;

double truncated(double squared, double limit) { return std::min(squared, limit); }

}  // namespace

std::uint64_t RelativeMotionEstimator::random() {
  random_state_ ^= random_state_ << 13;
  random_state_ ^= random_state_ >> 7;
  random_state_ ^= random_state_ << 17;
  return random_state_;
}

template <std::size_t kCount>
void RelativeMotionEstimator::choose(std::size_t (&chosen)[kCount]) {
  for (std::size_t i = 0; i < kCount; ++i) {
    do {
      chosen[i] = random() % pairs_->size();
    } while (std::find(chosen, chosen + i, chosen[i]) != chosen + i);
  }
}

RelativeMotion RelativeMotionEstimator::estimate(const std::vector<RayPair>& pairs,
                                                 double ray_sigma_rad,
                                                 const std::optional<RotationPrior>& prior) {
  RelativeMotion out;
  if (pairs.size() < config_.min_points) return out;
  pairs_ = &pairs;
  sigma_rad_ = ray_sigma_rad;
  random_state_ = kSeed;
  const auto n = static_cast<double>(pairs.size());
  Hypothesis turned = find_rotation(prior);
  refine_rotation(turned, prior, nullptr);
  turned.cost = rotation_cost(turned.rotation);
  // GRIC: cost of the residuals, of the model's dimension for each point, of its parameters.
  const auto gric = [&](double cost, double dimension, double parameters) {
    return cost + std::log(4.0) * dimension * n + std::log(4.0 * n) * parameters;
  };
  Hypothesis moved = find_essential(turned, prior.has_value());
  refine(moved, prior, nullptr);
  moved.cost = epipolar_cost(moved);
  std::optional<Hypothesis> plane = find_homography(turned);
  const double by_turn = gric(turned.cost, 2.0, 3.0);
  const double by_essential = gric(moved.cost, 3.0, 5.0);
  const double by_plane = plane ? gric(plane->cost, 2.0, 8.0) : by_essential;
  if (by_turn <= std::min(by_essential, by_plane)) {
    out.model = MotionModel::kRotation;
    refine_rotation(turned, prior, &out);
    describe(turned, out);
  } else {
    const bool flat = by_plane < by_essential;
    out.model = flat ? MotionModel::kHomography : MotionModel::kEssential;
    Hypothesis& best = flat ? *plane : moved;
    refine(best, prior, &out);
    face_forward(best);
    describe(best, out);
  }
  if (static_cast<double>(out.inliers) < config_.min_inlier_share * n)
    out.model = MotionModel::kNone;
  return out;
}

// The rotation that leaves most rays where they are, from pairs of points.
RelativeMotionEstimator::Hypothesis RelativeMotionEstimator::find_rotation(
    const std::optional<RotationPrior>& prior) {
  Hypothesis best;
  if (prior) best.rotation = prior->earlier_from_later;
  best.cost = rotation_cost(best.rotation);
  for (int i = 0; i < config_.samples; ++i) {
    std::size_t chosen[2];
    choose(chosen);
    const RayPair& a = (*pairs_)[chosen[0]];
    const RayPair& b = (*pairs_)[chosen[1]];
    Matrix3d earlier, later;
    earlier << a.earlier, b.earlier, a.earlier.cross(b.earlier);
    later << a.later, b.later, a.later.cross(b.later);
    if (earlier.col(2).norm() < 0.05 || later.col(2).norm() < 0.05) continue;
    const auto triad = [](const Matrix3d& m) {
      Matrix3d t;
      t.col(0) = (m.col(0) + m.col(1)).normalized();
      t.col(1) = m.col(2).normalized();
      t.col(2) = t.col(0).cross(t.col(1));
      return t;
    };
    Hypothesis h;
    h.rotation = triad(earlier) * triad(later).transpose();
    h.cost = rotation_cost(h.rotation);
    if (h.cost < best.cost) best = h;
  }
  return best;
}

RelativeMotionEstimator::Hypothesis RelativeMotionEstimator::find_essential(
    const Hypothesis& turned, bool rotation_known) {
  Hypothesis best = turned;
  best.cost = std::numeric_limits<double>::infinity();
  for (int i = 0; i < config_.samples; ++i) {
    std::size_t chosen[5];
    choose(chosen);
    const RayPair& a = (*pairs_)[chosen[0]];
    const RayPair& b = (*pairs_)[chosen[1]];
    // With the rotation known, each point's plane holds the movement: two planes cross in it.
    const Vector3d line = a.earlier.cross(turned.rotation * a.later)
                              .cross(b.earlier.cross(turned.rotation * b.later));
    if (!(line.norm() > 1e-12)) continue;
    Hypothesis h{turned.rotation, line.normalized(), 0.0};
    if (!rotation_known && !solve_five(chosen, h)) continue;
    h.cost = epipolar_cost(h);
    if (h.cost < best.cost) best = h;
  }
  if (best.direction.isZero()) best.direction = Vector3d::UnitZ();
  return best;
}

// Newton's method for the five points: five equations, five unknowns.
bool RelativeMotionEstimator::solve_five(const std::size_t (&chosen)[5], Hypothesis& h) const {
  for (int step = 0; step < kFivePointSteps; ++step) {
    const auto basis = across(h.direction);
    Eigen::Matrix<double, 5, 5> jacobian;
    Eigen::Matrix<double, 5, 1> value;
    for (int i = 0; i < 5; ++i) {
      const Coplanarity c = coplanarity((*pairs_)[chosen[i]], h.rotation, h.direction, sigma_rad_);
      value(i) = c.value;
      jacobian.row(i) << c.by_rotation, c.by_direction * basis;
    }
    const Eigen::Matrix<double, 5, 1> change = jacobian.partialPivLu().solve(-value);
    if (!change.allFinite() || change.norm() > 1.0) return false;
    h.rotation = exp_rotation(change.head<3>()).toRotationMatrix() * h.rotation;
    h.direction = (h.direction + basis * change.tail<2>()).normalized();
    if (change.norm() < 1e-6) break;
  }
  return true;
}

double RelativeMotionEstimator::rotation_cost(const Matrix3d& rotation) const {
  const double limit = config_.inlier_sigmas * config_.inlier_sigmas;
  const double scale = 1.0 / (2.0 * sigma_rad_ * sigma_rad_);
  double cost = 0.0;
  for (const RayPair& p : *pairs_) {
    cost += truncated((p.earlier - rotation * p.later).squaredNorm() * scale, limit);
  }
  return cost;
}

double RelativeMotionEstimator::epipolar_cost(const Hypothesis& h) const {
  const double limit = config_.inlier_sigmas * config_.inlier_sigmas;
  double cost = 0.0;
  for (const RayPair& p : *pairs_) {
    const double value = coplanarity(p, h.rotation, h.direction, sigma_rad_).value;
    cost += truncated(value * value, limit);
  }
  return cost;
}

// Of the two directions with the same planes, the one from which points lie ahead of both cameras:
// what the camera moves towards, the rays of points move away from.
void RelativeMotionEstimator::face_forward(Hypothesis& h) const {
  double agreement = 0.0;
  for (const RayPair& p : *pairs_) {
    const Vector3d shift = p.earlier - h.rotation * p.later;
    const double along = shift.dot(h.direction - h.direction.dot(p.earlier) * p.earlier);
    agreement += along / (std::abs(along) + sigma_rad_ * sigma_rad_);
  }
  if (agreement < 0.0) h.direction = -h.direction;
}

void RelativeMotionEstimator::describe(const Hypothesis& h, RelativeMotion& out) {
  out.earlier_from_later = h.rotation;
  const bool moved = out.model != MotionModel::kRotation;
  if (moved) out.direction = h.direction;
  const double limit = config_.inlier_sigmas * config_.inlier_sigmas;
  parallax_.clear();
  for (const RayPair& p : *pairs_) {
    const double turned = (p.earlier - h.rotation * p.later).norm();
    const double value = moved ? coplanarity(p, h.rotation, h.direction, sigma_rad_).value
                               : turned / (std::sqrt(2.0) * sigma_rad_);
    if (value * value < limit) parallax_.push_back(turned);
  }
  out.inliers = parallax_.size();
  if (parallax_.empty()) return;
  const auto middle = parallax_.begin() + static_cast<std::ptrdiff_t>(parallax_.size() / 2);
  std::nth_element(parallax_.begin(), middle, parallax_.end());
  out.parallax_rad = *middle;
}

// ------------------------------------------------------------------------------- plane

double RelativeMotionEstimator::homography_cost(const Matrix3d& later_from_earlier) const {
  const double limit = config_.inlier_sigmas * config_.inlier_sigmas;
  const double scale = 1.0 / (2.0 * sigma_rad_ * sigma_rad_);
  double cost = 0.0;
  for (const RayPair& p : *pairs_) {
    const Vector3d expected = (later_from_earlier * p.earlier).normalized();
    cost += truncated((expected - p.later).squaredNorm() * scale, limit);
  }
  return cost;
}

std::optional<RelativeMotionEstimator::Hypothesis> RelativeMotionEstimator::find_homography(
    const Hypothesis& turned) {
  Matrix3d best = turned.rotation.transpose();
  double best_cost = homography_cost(best);
  for (int i = 0; i < config_.samples / 2; ++i) {
    std::size_t chosen[4];
    choose(chosen);
    HomographyEquations equations = HomographyEquations::Zero();
    for (const std::size_t k : chosen) equations += equations_of((*pairs_)[k]);
    const Matrix3d h = solve_homography(equations, (*pairs_)[chosen[0]]);
    const double cost = homography_cost(h);
    if (cost < best_cost) {
      best = h;
      best_cost = cost;
    }
  }
  best = refined_homography(best);
  best_cost = homography_cost(best);
  std::optional<Hypothesis> found;
  double closest = 0.0;
  for (const PlaneMotion& m : decompose_homography(best)) {
    double ahead = 0.0;
    for (const RayPair& p : *pairs_) ahead += m.normal.dot(p.earlier) > 0.0 ? 1.0 : -1.0;
    if (ahead < 0.5 * static_cast<double>(pairs_->size())) continue;
    const Matrix3d rotation = m.later_from_earlier.transpose();
    const double off = (rotation - turned.rotation).squaredNorm();
    if (found && off >= closest) continue;
    closest = off;
    found = Hypothesis{rotation, m.movement.normalized(), best_cost};
  }
  return found;
}

Matrix3d RelativeMotionEstimator::refined_homography(const Matrix3d& start) const {
  const double limit =
      config_.inlier_sigmas * config_.inlier_sigmas * 2.0 * sigma_rad_ * sigma_rad_;
  HomographyEquations equations = HomographyEquations::Zero();
  const RayPair* seen = nullptr;
  for (const RayPair& p : *pairs_) {
    if (((start * p.earlier).normalized() - p.later).squaredNorm() > limit) continue;
    equations += equations_of(p);
    seen = &p;
  }
  return seen != nullptr ? solve_homography(equations, *seen) : start;
}

}  // namespace vpdr::vision
