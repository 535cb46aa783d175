#include "vision/core/odometry/plane_motion.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/rotation.hpp"

namespace vpdr::vision {

using Eigen::Matrix3d;
using Eigen::Vector3d;

HomographyEquations equations_of(const RayPair& pair) {
  const Matrix3d cross = skew(pair.later);
  Eigen::Matrix<double, 3, 9> rows;
  for (Eigen::Index k = 0; k < 3; ++k) rows.block<3, 3>(0, 3 * k) = cross * pair.earlier(k);
  return rows.transpose() * rows;
}

Matrix3d solve_homography(const HomographyEquations& equations, const RayPair& seen) {
  const Eigen::SelfAdjointEigenSolver<HomographyEquations> solver(equations);
  Matrix3d h;
  for (Eigen::Index k = 0; k < 3; ++k) h.col(k) = solver.eigenvectors().col(0).segment<3>(3 * k);
  return seen.later.dot(h * seen.earlier) < 0.0 ? (-h).eval() : h;
}

std::vector<PlaneMotion> decompose_homography(const Matrix3d& homography) {
  std::vector<PlaneMotion> out;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(homography.transpose() * homography);
  const double middle = solver.eigenvalues()(1);
  if (!(middle > 0.0)) return out;
  const Matrix3d h = homography / std::sqrt(middle);
  const double large = solver.eigenvalues()(2) / middle;
  const double small = solver.eigenvalues()(0) / middle;
  if (large - small < 1e-9) return out;
  const Vector3d v1 = solver.eigenvectors().col(2);
  const Vector3d v2 = solver.eigenvectors().col(1);
  const Vector3d v3 = solver.eigenvectors().col(0);
  const double along = std::sqrt(std::max(0.0, 1.0 - small) / (large - small));
  const double beside = std::sqrt(std::max(0.0, large - 1.0) / (large - small));
  for (const double sign : {1.0, -1.0}) {
    const Vector3d u = along * v1 + sign * beside * v3;
    Matrix3d before, after;
    before << v2, u, v2.cross(u);
    after << h * v2, h * u, (h * v2).cross(h * u);
    const Matrix3d rotation = after * before.transpose();
    const Vector3d normal = v2.cross(u);
    const Vector3d shift = (h - rotation) * normal;
    // later = R (earlier - movement (normal . earlier) / distance)
    const Vector3d movement = -rotation.transpose() * shift;
    out.push_back({rotation, movement, normal});
    out.push_back({rotation, -movement, -normal});
  }
  return out;
}

}  // namespace vpdr::vision
