#include "simulation/camera.hpp"

namespace vpdr::simulation {

using Eigen::Vector2d;
using Eigen::Vector3d;

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

Vector2d Camera::distort(const Vector2d& n) const {
  const auto& [k1, k2, p1, p2] = distortion;
  const double r2 = n.squaredNorm();
  const double radial = 1.0 + r2 * (k1 + r2 * k2);
  return {n.x() * radial + 2.0 * p1 * n.x() * n.y() + p2 * (r2 + 2.0 * n.x() * n.x()),
          n.y() * radial + p1 * (r2 + 2.0 * n.y() * n.y()) + 2.0 * p2 * n.x() * n.y()};
}

Vector2d Camera::normalised(const Vector2d& pixel) const {
  const Vector2d distorted((pixel.x() - cx) / fx, (pixel.y() - cy) / fy);
  Vector2d n = distorted;
  for (int i = 0; i < 30; ++i) n += distorted - distort(n);
  return n;
}

std::optional<Vector2d> Camera::project(const Vector3d& point_m) const {
  if (!(point_m.z() > 1e-6)) return std::nullopt;
  const Vector2d d = distort(point_m.head<2>() / point_m.z());
  return Vector2d(fx * d.x() + cx, fy * d.y() + cy);
}

}  // namespace vpdr::simulation
