#pragma once
// The camera on the walker's board: a pinhole with radial-tangential distortion (Brown-Conrady, as
// OpenCV and EuRoC have it) or an equidistant fisheye (Kannala and Brandt 2006, as Kalibr has it).
// Camera axes x right, y down, z forward; pixels count from the centre of the upper left one. It is
// independent of vision's own model, so that each checks the other.
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>

namespace vpdr::simulation {

enum class Lens : std::uint8_t {
  kRadialTangential,  ///< k1 k2 p1 p2 k3
  kEquidistant,       ///< k1 k2 k3 k4 of a fisheye; fx and fy in pixels per radian
};

struct Camera {
  int width = 640;
  int height = 480;
  double fx = 460.0;
  double fy = 460.0;
  double cx = 319.5;
  double cy = 239.5;
  Lens lens = Lens::kRadialTangential;
  std::array<double, 5> distortion = {-0.06, 0.008, 0.0, 0.0, 0.0};
  /// Camera to board axes; by default 5 cm ahead of the board, looking 7 degrees down.
  Eigen::Isometry3d body_from_camera = looking_ahead({0.05, 0.0, 0.02}, 0.122);

  /// A camera at `place_m` in the board's forward-left-up axes, turned `down_rad` below forward.
  static Eigen::Isometry3d looking_ahead(const Eigen::Vector3d& place_m, double down_rad);

  /// Unit vector, camera axes, to what a pixel sees; the pixel may lie outside the image. The lens
  /// is inverted by Newton's method.
  [[nodiscard]] Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
  /// Pixel of a point in camera axes (it may lie outside the image); none where the lens cannot see
  /// it: behind a pinhole, straight behind a fisheye.
  [[nodiscard]] std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& point_m) const;
};

}  // namespace vpdr::simulation
