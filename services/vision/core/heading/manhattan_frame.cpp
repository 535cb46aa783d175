#include "vision/core/heading/manhattan_frame.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"
#include "vision/core/across.hpp"

namespace vpdr::vision {
namespace {

// The inlier angle is first this many times wider, so that a start a few degrees off converges.
constexpr double kFirstWidening = 3.0;
// A turn nobody measured has a standard deviation of a radian rather than an infinite one.
constexpr double kLeastInformation = 1.0;

struct Match {
  int axis = 0;
  double squared_sine = 1.0;
};

Match match(const SphereSegment& s, const Eigen::Matrix3d& r) {
  Match best;
  for (int axis = 0; axis < 3; ++axis) {
    const double squared_sine = squared_sine_to(s, r.col(axis));
    if (squared_sine < best.squared_sine) best = {axis, squared_sine};
  }
  return best;
}

double residual_variance(const SphereSegment& s, const Eigen::Vector3d& a, double model_sigma) {
  const double tilt2 = s.tilt_sigma_rad * s.tilt_sigma_rad + model_sigma * model_sigma;
  const double with = s.along.dot(a);
  const double shift = s.shift_sigma_rad * s.middle.dot(a);
  return tilt2 * with * with + shift * shift + 1e-10;
}

struct NormalEquations {
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity() * kLeastInformation;
  Eigen::Vector3d gradient = Eigen::Vector3d::Zero();
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();  ///< of the gradient, from the residuals
  int inliers = 0;
};

NormalEquations gather(const std::vector<SphereSegment>& segments, const Eigen::Matrix3d& r,
                       const VerticalPrior& prior, double limit_rad, double model_sigma) {
  NormalEquations e;
  const double limit = std::pow(std::sin(limit_rad), 2);
  for (const SphereSegment& s : segments) {
    const Match m = match(s, r);
    if (m.squared_sine >= limit) continue;
    const Eigen::Vector3d a = r.col(m.axis);
    const double robust = std::pow(1.0 - m.squared_sine / limit, 2);
    const double w = robust / residual_variance(s, a, model_sigma);
    const double residual = s.normal.dot(a);
    const Eigen::Vector3d jacobian = a.cross(s.normal);
    e.information += w * jacobian * jacobian.transpose();
    e.gradient += w * residual * jacobian;
    e.scatter += w * w * residual * residual * jacobian * jacobian.transpose();
    ++e.inliers;
  }
  const Eigen::Vector3d up = r.col(2);
  const double belief = 1.0 / (prior.sigma_rad * prior.sigma_rad);
  e.information += belief * (Eigen::Matrix3d::Identity() - up * up.transpose());
  e.gradient -= belief * up.cross(prior.up);
  e.scatter += belief * (Eigen::Matrix3d::Identity() - up * up.transpose());
  return e;
}

// The larger of what the end points' uncertainty promises and what the residuals show (White's
// robust covariance, corrected for the three unknowns).
Eigen::Matrix3d covariance_of(const NormalEquations& e) {
  const Eigen::Matrix3d promised = e.information.inverse();
  const double correction = e.inliers > 3 ? e.inliers / (e.inliers - 3.0) : 4.0;
  const Eigen::Matrix3d shown = promised * e.scatter * promised * correction;
  return shown.trace() > promised.trace() ? shown : promised;
}

void count_support(const std::vector<SphereSegment>& segments, double limit_rad,
                   ManhattanFrame& frame) {
  const double limit = std::pow(std::sin(limit_rad), 2);
  frame.inliers = {};
  frame.support = {};
  frame.unexplained = 0.0;
  for (const SphereSegment& s : segments) {
    const Match m = match(s, frame.camera_from_corridor);
    if (m.squared_sine >= limit) {
      frame.unexplained += s.weight;
      continue;
    }
    const auto axis = static_cast<std::size_t>(m.axis);
    ++frame.inliers[axis];
    frame.support[axis] += s.weight * (1.0 - m.squared_sine / limit);
  }
}

}  // namespace

std::optional<int> direction_of(const SphereSegment& segment, const Eigen::Matrix3d& directions,
                                double limit_rad) {
  const Match m = match(segment, directions);
  if (m.squared_sine >= std::pow(std::sin(limit_rad), 2)) return std::nullopt;
  return m.axis;
}

ManhattanFrame refine_frame(const std::vector<SphereSegment>& segments,
                            const Eigen::Matrix3d& start, const VerticalPrior& prior,
                            const RefineConfig& config) {
  ManhattanFrame frame;
  Eigen::Matrix3d r = start;
  for (int i = 0; i < config.iterations; ++i) {
    const double widening = std::max(1.0, kFirstWidening - i);
    const NormalEquations e =
        gather(segments, r, prior, config.inlier_angle_rad * widening, config.model_sigma_rad);
    const Eigen::Vector3d turn = -e.information.ldlt().solve(e.gradient);
    r = exp_rotation(turn).toRotationMatrix() * r;
    if (widening == 1.0 && turn.squaredNorm() < 1e-14) break;
  }
  const NormalEquations e =
      gather(segments, r, prior, config.inlier_angle_rad, config.model_sigma_rad);
  frame.camera_from_corridor = r;
  frame.covariance_rad2 = covariance_of(e);
  count_support(segments, config.inlier_angle_rad, frame);
  return frame;
}

namespace {

struct Across {
  Eigen::Matrix2d information;
  Eigen::Vector2d gradient;
  Eigen::Matrix2d scatter;
  int inliers = 0;
};

Across gather_across(const std::vector<SphereSegment>& segments, const Eigen::Matrix3d& frame,
                     int axis, const Eigen::Vector3d& d, const Eigen::Matrix<double, 3, 2>& b,
                     const RefineConfig& refine, double belief) {
  Across e{Eigen::Matrix2d::Identity() * belief, belief * b.transpose() * (d - frame.col(axis)),
           Eigen::Matrix2d::Identity() * belief};
  const double limit = std::pow(std::sin(refine.inlier_angle_rad), 2);
  for (const SphereSegment& s : segments) {
    const double squared_sine = squared_sine_to(s, d);
    if (squared_sine >= limit || match(s, frame).axis != axis) continue;
    const double residual = s.normal.dot(d);
    const Eigen::Vector2d jacobian = b.transpose() * s.normal;
    const double w =
        std::pow(1.0 - squared_sine / limit, 2) / residual_variance(s, d, refine.model_sigma_rad);
    e.information += w * jacobian * jacobian.transpose();
    e.gradient += w * residual * jacobian;
    e.scatter += w * w * residual * residual * jacobian * jacobian.transpose();
    ++e.inliers;
  }
  return e;
}

}  // namespace

std::array<FreeDirection, 3> free_directions(const std::vector<SphereSegment>& segments,
                                             const Eigen::Matrix3d& frame,
                                             const RefineConfig& refine, const FreeConfig& config) {
  std::array<FreeDirection, 3> out;
  const double belief = 1.0 / std::pow(config.orthogonality_sigma_rad, 2);
  for (int axis = 0; axis < 3; ++axis) {
    FreeDirection& free = out[static_cast<std::size_t>(axis)];
    free.direction = frame.col(axis);
    for (int i = 0; i <= config.iterations; ++i) {
      const Eigen::Matrix<double, 3, 2> b = across(free.direction);
      const Across e = gather_across(segments, frame, axis, free.direction, b, refine, belief);
      const Eigen::Matrix2d promised = e.information.inverse();
      if (i == config.iterations) {
        const Eigen::Matrix2d shown = promised * e.scatter * promised;
        free.variance_rad2 = std::max(promised.trace(), shown.trace());
        break;
      }
      free.direction = (free.direction - b * (promised * e.gradient)).normalized();
    }
  }
  return out;
}

ManhattanFrame face_forward(const ManhattanFrame& frame) {
  ManhattanFrame out = frame;
  const Eigen::Matrix3d& r = frame.camera_from_corridor;
  const bool swapped = std::abs(r(2, 1)) > std::abs(r(2, 0));
  Eigen::Vector3d forward = r.col(swapped ? 1 : 0);
  if (forward.z() < 0.0) forward = -forward;
  out.camera_from_corridor << forward, r.col(2).cross(forward), r.col(2);
  if (swapped) {
    std::swap(out.inliers[0], out.inliers[1]);
    std::swap(out.support[0], out.support[1]);
  }
  return out;
}

}  // namespace vpdr::vision
