#pragma once
// The epipolar constraint (S1.8): a point seen from two places, and the way between them, lie in
// one plane. Camera axes: x right, y down, z forward; radians. Allocates nothing.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "vision/core/across.hpp"
#include "vision/core/odometry/plane_motion.hpp"

namespace vpdr::vision {

/// The coplanarity of the two rays and the movement, in sigmas, and its derivatives.
struct Coplanarity {
  double value = 0.0;
  Eigen::Matrix<double, 1, 3> by_rotation;
  Eigen::Matrix<double, 1, 3> by_direction;
};

inline Coplanarity coplanarity(const RayPair& pair, const Eigen::Matrix3d& rotation,
                               const Eigen::Vector3d& direction, double sigma) {
  const Eigen::Vector3d later = rotation * pair.later;  // in the earlier camera's axes
  const Eigen::Vector3d normal = pair.earlier.cross(later);
  const Eigen::Vector3d moved = direction.cross(pair.earlier);
  // First-order noise of both rays (Sampson).
  const double spread =
      sigma * std::sqrt(later.cross(direction).squaredNorm() + moved.squaredNorm() + 1e-12);
  Coplanarity c;
  c.value = direction.dot(normal) / spread;
  c.by_rotation = later.cross(moved).transpose() / spread;
  c.by_direction = normal.transpose() / spread;
  return c;
}

}  // namespace vpdr::vision
