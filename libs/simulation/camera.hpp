#pragma once
// The camera on the walker's board: pinhole with radial-tangential distortion (Brown-Conrady, as
// OpenCV and EuRoC have it). Camera axes x right, y down, z forward; pixels count from the centre
// of the upper left one.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>

namespace vpdr::simulation {

struct Camera {
  int width = 640;
  int height = 480;
  double fx = 460.0;
  double fy = 460.0;
  double cx = 319.5;
  double cy = 239.5;
  std::array<double, 4> distortion = {-0.06, 0.008, 0.0, 0.0};  ///< k1 k2 p1 p2
  /// Camera to board axes; by default 5 cm ahead of the board, looking 7 degrees down.
  Eigen::Isometry3d body_from_camera = looking_ahead({0.05, 0.0, 0.02}, 0.122);

  /// A camera at `place_m` in the board's forward-left-up axes, turned `down_rad` below forward.
  static Eigen::Isometry3d looking_ahead(const Eigen::Vector3d& place_m, double down_rad);

  /// Distorted from undistorted normalised image coordinates.
  [[nodiscard]] Eigen::Vector2d distort(const Eigen::Vector2d& normalised) const;
  /// Undistorted normalised coordinates of a pixel, by fixed-point iteration.
  [[nodiscard]] Eigen::Vector2d normalised(const Eigen::Vector2d& pixel) const;
  /// Pixel of a point in camera axes; none behind the camera (it may lie outside the image).
  [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_m) const;
};

}  // namespace vpdr::simulation
