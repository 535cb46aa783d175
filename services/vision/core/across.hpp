#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace vpdr::vision {

/// Columns: two unit vectors across the unit vector `axis`, perpendicular to each other.
inline Eigen::Matrix<double, 3, 2> across(const Eigen::Vector3d& axis) {
  Eigen::Matrix<double, 3, 2> basis;
  basis.col(0) = axis.unitOrthogonal();
  basis.col(1) = axis.cross(basis.col(0));
  return basis;
}

}  // namespace vpdr::vision
