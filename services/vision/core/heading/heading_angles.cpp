#include "vision/core/heading/heading_angles.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace vpdr::vision {

std::optional<ViewAngles> printed_view_angles(const Eigen::Vector2d& pixel,
                                              const Eigen::Vector2d& centre,
                                              const Eigen::Vector2d& focal) {
  const double sine = (pixel.x() - centre.x()) / focal.x();
  if (!(std::abs(sine) < 1.0)) return std::nullopt;
  const double theta = std::asin(sine);
  const double pitch_sine = (pixel.y() - centre.y()) / (focal.y() * std::cos(theta));
  if (!(std::abs(pitch_sine) <= 1.0)) return std::nullopt;
  return ViewAngles{theta, std::asin(pitch_sine), 0.0};
}

ViewAngles ray_view_angles(const Eigen::Vector3d& ray) {
  return {std::atan2(ray.x(), ray.z()), std::atan2(ray.y(), std::hypot(ray.x(), ray.z())), 0.0};
}

ViewAngles level_view_angles(const Eigen::Matrix3d& camera_from_corridor) {
  // The optical axis in the corridor's axes: forward, left, up.
  const Eigen::Vector3d axis = camera_from_corridor.row(2).transpose();
  const Eigen::Vector3d up = camera_from_corridor.col(2);
  return {std::atan2(axis.y(), axis.x()), std::atan2(axis.z(), std::hypot(axis.x(), axis.y())),
          std::atan2(-up.x(), -up.y())};
}

Eigen::Matrix3d triplet_from_angles(const TripletAngles& a) {
  const double ca = std::cos(a.alpha_rad);
  const double sa = std::sin(a.alpha_rad);
  const double cb = std::cos(a.beta_rad);
  const double sb = std::sin(a.beta_rad);
  const double cg = std::cos(a.gamma_rad);
  const double sg = std::sin(a.gamma_rad);
  Eigen::Matrix3d v;
  v.col(0) << ca * cb, sa * cb, -sb;
  v.col(1) << ca * sb * sg - sa * cg, sa * sb * sg + ca * cg, cb * sg;
  v.col(2) << ca * sb * cg + sa * sg, sa * sb * cg - ca * sg, cb * cg;
  return v;
}

TripletAngles angles_from_triplet(const Eigen::Matrix3d& directions) {
  const Eigen::Matrix3d v = nearest_rotation(directions);
  TripletAngles a;
  a.beta_rad = -std::asin(std::clamp(v(2, 0), -1.0, 1.0));
  if (std::abs(v(2, 0)) > 1.0 - 1e-12) {
    a.alpha_rad = std::atan2(-v(0, 1), v(1, 1));
    return a;
  }
  a.alpha_rad = std::atan2(v(1, 0), v(0, 0));
  a.gamma_rad = std::atan2(v(2, 1), v(2, 2));
  return a;
}

ViewAngles triplet_view_angles(const Eigen::Matrix3d& camera_from_corridor) {
  // Rows: up, forward, left of the camera; columns: up, forward, left of the corridor.
  const auto in_printed_axes = [](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(-v.y(), v.z(), -v.x());
  };
  Eigen::Matrix3d directions;
  directions << in_printed_axes(camera_from_corridor.col(2)),
      in_printed_axes(camera_from_corridor.col(0)), in_printed_axes(camera_from_corridor.col(1));
  const TripletAngles a = angles_from_triplet(directions);
  return {-a.gamma_rad, a.alpha_rad, -a.beta_rad};
}

Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& directions) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(directions,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0.0) u.col(2) *= -1.0;
  return u * svd.matrixV().transpose();
}

}  // namespace vpdr::vision
