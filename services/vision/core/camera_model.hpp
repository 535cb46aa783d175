#pragma once
// One camera: pixels to unit rays and back, with lens distortion, and how it sits on the body.
// Camera axes: x right, y down, z forward. Pixel (0, 0) is the centre of the upper left pixel.
// Immutable after construction, therefore safe to share between threads. Allocates nothing.
// Sources: radial-tangential: Brown 1966 as in OpenCV (k1 k2 p1 p2 k3); equidistant: Kannala and
// Brandt 2006 as in Kalibr and OpenCV's fisheye module (k1 k2 k3 k4).
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>

namespace vpdr::vision {

enum class Distortion : std::uint8_t {
  kNone,
  kRadialTangential,  ///< k1 k2 p1 p2 k3
  kEquidistant,       ///< k1 k2 k3 k4 of a fisheye; fx fy in pixels per radian
};

/// body_from_camera of a camera that looks forward and stands upright: x right -> -left,
/// y down -> -up, z -> forward.
Eigen::Matrix3d forward_looking_body_from_camera();

/// What a calibration says. Pixels; coefficients that the model does not use must be zero.
struct CameraParameters {
  int width_px = 0;  ///< 0: any size is accepted
  int height_px = 0;
  double fx_px = 0.0;
  double fy_px = 0.0;
  double cx_px = 0.0;
  double cy_px = 0.0;
  Distortion distortion = Distortion::kNone;
  std::array<double, 5> coefficients{};
  Eigen::Matrix3d body_from_camera = forward_looking_body_from_camera();
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< of the camera, body axes
  double height_m = 0.0;                                 ///< above the floor as worn; 0: unknown
};

class CameraModel {
 public:
  explicit CameraModel(const CameraParameters& parameters) : p_(parameters) {}

  [[nodiscard]] const CameraParameters& parameters() const { return p_; }

  /// Unit ray through a pixel. The lens is inverted by Newton's method, which is exact wherever
  /// the distortion is monotonic, that is inside any calibrated image, and finite elsewhere.
  [[nodiscard]] Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;

  /// Pixel of a direction of any length; nothing where the lens cannot see it (behind a pinhole).
  [[nodiscard]] std::optional<Eigen::Vector2d> pixel(const Eigen::Vector3d& direction) const;

  /// Pixel of the same direction in an ideal pinhole camera with these fx fy cx cy: the
  /// coordinates in which S1.6 is written.
  [[nodiscard]] std::optional<Eigen::Vector2d> undistorted_pixel(
      const Eigen::Vector3d& direction) const;

  /// Mean focal length: pixels per radian near the image centre.
  [[nodiscard]] double focal_px() const { return 0.5 * (p_.fx_px + p_.fy_px); }

 private:
  [[nodiscard]] Eigen::Vector2d distort(const Eigen::Vector2d& plane,
                                        Eigen::Matrix2d* jacobian) const;
  [[nodiscard]] Eigen::Vector2d undistort(const Eigen::Vector2d& distorted) const;
  [[nodiscard]] double equidistant_radius(double angle_rad) const;
  [[nodiscard]] double equidistant_angle(double radius) const;

  CameraParameters p_;
};

}  // namespace vpdr::vision
