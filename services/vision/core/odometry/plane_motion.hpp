#pragma once
// The homography of a plane seen in two frames, and the motions it can stand for (Ma, Soatto,
// Kosecka and Sastry 2004, 5.3). Rays are unit vectors in camera axes: x right, y down, z forward.
// Pure functions, thread-safe.
#include <Eigen/Core>
#include <vector>

namespace vpdr::vision {

/// Unit rays to one point in the two frames, each in its own camera's axes.
struct RayPair {
  Eigen::Vector3d earlier = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d later = Eigen::Vector3d::UnitZ();
};

/// Sum of the points' equations, squared, for the homography's nine numbers, column by column.
using HomographyEquations = Eigen::Matrix<double, 9, 9>;
HomographyEquations equations_of(const RayPair& pair);
/// The homography (later from earlier) that solves them best; `seen` tells its sign.
Eigen::Matrix3d solve_homography(const HomographyEquations& equations, const RayPair& seen);

/// The two motions that a homography (later from earlier, of rays) can stand for, each with the
/// plane's normal in the earlier axes; nothing for a rotation.
struct PlaneMotion {
  Eigen::Matrix3d later_from_earlier = Eigen::Matrix3d::Identity();
  Eigen::Vector3d movement = Eigen::Vector3d::Zero();  ///< over the plane's distance, earlier axes
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< away from the camera
};
std::vector<PlaneMotion> decompose_homography(const Eigen::Matrix3d& homography);

}  // namespace vpdr::vision
