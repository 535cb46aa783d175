#include "vision/core/camera_model.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace vpdr::vision {
namespace {

constexpr int kNewtonSteps = 20;
constexpr double kConverged = 1e-12;

}  // namespace

Eigen::Matrix3d forward_looking_body_from_camera() {
  Eigen::Matrix3d r;
  r << 0.0, 0.0, 1.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  return r;
}

// Radial-tangential distortion of a point of the plane z = 1, and its derivative.
Eigen::Vector2d CameraModel::distort(const Eigen::Vector2d& plane,
                                     Eigen::Matrix2d* jacobian) const {
  const auto& [k1, k2, p1, p2, k3] = p_.coefficients;
  const double x = plane.x();
  const double y = plane.y();
  const double r2 = x * x + y * y;
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  if (jacobian != nullptr) {
    const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + 3.0 * k3 * r2));
    (*jacobian)(0, 0) = radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x;
    (*jacobian)(0, 1) = slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y;
    (*jacobian)(1, 0) = (*jacobian)(0, 1);
    (*jacobian)(1, 1) = radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
  }
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

// Newton's method; beyond the radius up to which the lens is monotonic, the best point met.
Eigen::Vector2d CameraModel::undistort(const Eigen::Vector2d& distorted) const {
  Eigen::Vector2d plane = distorted;
  Eigen::Vector2d best = distorted;
  double best_error = std::numeric_limits<double>::infinity();
  Eigen::Matrix2d jacobian;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const Eigen::Vector2d error = distort(plane, &jacobian) - distorted;
    if (!(error.squaredNorm() < best_error)) break;
    best_error = error.squaredNorm();
    best = plane;
    if (best_error < kConverged * kConverged || !(jacobian.determinant() > 1e-9)) break;
    plane -= jacobian.inverse() * error;
  }
  return best;
}

double CameraModel::equidistant_radius(double a) const {
  const auto& k = p_.coefficients;
  const double a2 = a * a;
  return a * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
}

double CameraModel::equidistant_angle(double radius) const {
  const auto& k = p_.coefficients;
  double a = radius;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double a2 = a * a;
    const double slope =
        1.0 + a2 * (3.0 * k[0] + a2 * (5.0 * k[1] + a2 * (7.0 * k[2] + a2 * 9.0 * k[3])));
    if (std::abs(slope) < 1e-9) break;
    const double step = (equidistant_radius(a) - radius) / slope;
    a -= step;
    if (std::abs(step) < kConverged) break;
  }
  return a;
}

Eigen::Vector3d CameraModel::ray(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d plane((pixel.x() - p_.cx_px) / p_.fx_px, (pixel.y() - p_.cy_px) / p_.fy_px);
  if (p_.distortion == Distortion::kEquidistant) {
    const double radius = plane.norm();
    if (radius < 1e-12) return Eigen::Vector3d::UnitZ();
    const double angle = equidistant_angle(radius);
    const Eigen::Vector2d side = plane * (std::sin(angle) / radius);
    return {side.x(), side.y(), std::cos(angle)};
  }
  const Eigen::Vector2d ideal =
      p_.distortion == Distortion::kRadialTangential ? undistort(plane) : plane;
  return Eigen::Vector3d(ideal.x(), ideal.y(), 1.0).normalized();
}

std::optional<Eigen::Vector2d> CameraModel::pixel(const Eigen::Vector3d& d) const {
  Eigen::Vector2d plane;
  if (p_.distortion == Distortion::kEquidistant) {
    const double side = d.head<2>().norm();
    if (side < 1e-12 && d.z() <= 0.0) return std::nullopt;
    const double radius = equidistant_radius(std::atan2(side, d.z()));
    plane = side < 1e-12 ? Eigen::Vector2d::Zero().eval() : (d.head<2>() * (radius / side)).eval();
  } else {
    if (d.z() <= 1e-9 * d.norm()) return std::nullopt;
    plane = d.head<2>() / d.z();
    if (p_.distortion == Distortion::kRadialTangential) plane = distort(plane, nullptr);
  }
  return Eigen::Vector2d(p_.cx_px + p_.fx_px * plane.x(), p_.cy_px + p_.fy_px * plane.y());
}

std::optional<Eigen::Vector2d> CameraModel::undistorted_pixel(const Eigen::Vector3d& d) const {
  if (d.z() <= 1e-9 * d.norm()) return std::nullopt;
  return Eigen::Vector2d(p_.cx_px + p_.fx_px * d.x() / d.z(), p_.cy_px + p_.fy_px * d.y() / d.z());
}

}  // namespace vpdr::vision
