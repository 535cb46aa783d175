#include "simulation/camera.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Coefficients = std::array<double, 5>;

constexpr int kNewtonSteps = 20;
constexpr double kConverged = 1e-14;

/// Distorted from undistorted normalised image coordinates, with the derivatives.
Vector2d distort(const Coefficients& k, const Vector2d& n, Matrix2d& jacobian) {
  const auto& [k1, k2, p1, p2, k3] = k;
  const double x = n.x(), y = n.y(), r2 = n.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2.0 * (k1 + r2 * (2.0 * k2 + 3.0 * r2 * k3));  // of radial by x, over x
  jacobian << radial + slope * x * x + 2.0 * p1 * y + 6.0 * p2 * x,
      slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y, slope * x * y + 2.0 * p1 * x + 2.0 * p2 * y,
      radial + slope * y * y + 6.0 * p1 * y + 2.0 * p2 * x;
  return {x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
          y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y};
}

Vector2d undistort(const Coefficients& k, const Vector2d& distorted) {
  Vector2d n = distorted;
  for (int i = 0; i < kNewtonSteps; ++i) {
    Matrix2d jacobian;
    const Vector2d off = distorted - distort(k, n, jacobian);
    n += jacobian.inverse() * off;
    if (off.squaredNorm() < kConverged * kConverged) break;
  }
  return n;
}

/// Distance from the image centre, in focal lengths, of a ray at an angle from the optical axis.
double radius_of(const Coefficients& k, double angle) {
  const double a2 = angle * angle;
  return angle * (1.0 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))));
}

double angle_of(const Coefficients& k, double radius) {
  double angle = radius;
  for (int i = 0; i < kNewtonSteps; ++i) {
    const double a2 = angle * angle;
    const double slope =
        1.0 + a2 * (3.0 * k[0] + a2 * (5.0 * k[1] + a2 * (7.0 * k[2] + a2 * 9.0 * k[3])));
    const double off = radius - radius_of(k, angle);
    angle = std::clamp(angle + off / slope, 0.0, kPi);
    if (std::abs(off) < kConverged) break;
  }
  return angle;
}

}  // namespace

Eigen::Isometry3d Camera::looking_ahead(const Vector3d& place_m, double down_rad) {
  Eigen::Matrix3d level;  // columns: camera's right, down and forward in body axes
  level.col(0) = -Vector3d::UnitY();
  level.col(1) = -Vector3d::UnitZ();
  level.col(2) = Vector3d::UnitX();
  Eigen::Isometry3d body_from_camera = Eigen::Isometry3d::Identity();
  body_from_camera.linear() =
      Eigen::AngleAxisd(down_rad, Vector3d::UnitY()).toRotationMatrix() * level;
  body_from_camera.translation() = place_m;
  return body_from_camera;
}

Vector3d Camera::ray(const Vector2d& pixel) const {
  const Vector2d distorted((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  if (lens == Lens::kRadialTangential) {
    return undistort(distortion, distorted).homogeneous().normalized();
  }
  const double radius = distorted.norm();
  const double angle = angle_of(distortion, radius);
  const double share = radius > 0.0 ? std::sin(angle) / radius : 1.0;
  return {share * distorted.x(), share * distorted.y(), std::cos(angle)};
}

std::optional<Vector2d> Camera::project(const Vector3d& point_m) const {
  constexpr double kLeast = 1e-6;
  Vector2d d = Vector2d::Zero();
  if (lens == Lens::kRadialTangential) {
    if (!(point_m.z() > kLeast)) return std::nullopt;
    Matrix2d unused;
    d = distort(distortion, point_m.head<2>() / point_m.z(), unused);
  } else {
    const double aside = point_m.head<2>().norm();
    if (!(aside > kLeast || point_m.z() > kLeast)) return std::nullopt;
    const double radius = radius_of(distortion, std::atan2(aside, point_m.z()));
    if (aside > 0.0) d = radius / aside * point_m.head<2>();
  }
  return Vector2d(fx * d.x() + cx, fy * d.y() + cy);
}

}  // namespace vpdr::simulation
