#pragma once
// Vanishing directions to angles and back. Camera axes: x right, y down, z forward. Radians.
// Pure functions, thread-safe, no errors but where nullopt is returned.
// Sources: S1.6 (Laura's two angles of the main vanishing point), S1.7 (three orthogonal vanishing
// directions as the columns of a rotation).
#include <Eigen/Core>
#include <array>
#include <optional>

namespace vpdr::vision {

/// Direction of the camera relative to a corridor: heading counter-clockwise seen from above (the
/// vanishing point lies right of the centre when positive), pitch positive looking up (the
/// vanishing point lies below the centre).
struct ViewAngles {
  double heading_rad = 0.0;
  double pitch_rad = 0.0;
  double roll_rad = 0.0;  ///< positive with the right side down; zero where the form knows none
};

/// S1.6 as printed: theta = asin((x - u) / fx), phi = asin((y - v) / (fy cos theta)), where
/// (x, y) is the vanishing point in undistorted pixels. A pinhole has tan where the print says
/// sin, so it holds for small angles only. Nothing where an arcsine has no value.
std::optional<ViewAngles> printed_view_angles(const Eigen::Vector2d& pixel,
                                              const Eigen::Vector2d& centre,
                                              const Eigen::Vector2d& focal);

/// The same two angles, exact, of a camera that is not rolled: of the unit ray to the vanishing
/// point. Heading in (-pi, pi].
ViewAngles ray_view_angles(const Eigen::Vector3d& ray);

/// The same two angles of a camera in any attitude, and its roll. Columns of
/// `camera_from_corridor`: the corridor's direction, its left, up, all in camera axes.
ViewAngles level_view_angles(const Eigen::Matrix3d& camera_from_corridor);

/// S1.7: angles of R = Rz(alpha) Ry(beta) Rx(gamma); the print calls alpha pitch, beta roll and
/// gamma yaw in the camera's axes.
struct TripletAngles {
  double alpha_rad = 0.0;
  double beta_rad = 0.0;
  double gamma_rad = 0.0;
};

/// S1.7: the three orthogonal vanishing directions, the columns of Rz(alpha) Ry(beta) Rx(gamma).
Eigen::Matrix3d triplet_from_angles(const TripletAngles& angles);

/// S1.7 inverted: beta = -asin V1z, alpha = atan2(V1y, V1x), gamma = atan2(V2z, V3z). The
/// columns are re-orthogonalised first. At beta = +-90 deg gamma is set to zero.
TripletAngles angles_from_triplet(const Eigen::Matrix3d& directions);

/// S1.7's roll, pitch and yaw of a camera in any attitude, from all three directions. The print's
/// axes are those in which its names fit: x up, y forward, z left, of camera and building alike; so
/// heading = -gamma, pitch = alpha, roll = -beta. The turns come in the order yaw, roll, pitch:
/// with roll and pitch at once the heading is not that of the optical axis. `camera_from_corridor`
/// as in level_view_angles; nearly orthogonal directions do.
ViewAngles triplet_view_angles(const Eigen::Matrix3d& camera_from_corridor);

/// The rotation nearest to three nearly orthogonal directions (by singular values).
Eigen::Matrix3d nearest_rotation(const Eigen::Matrix3d& directions);

}  // namespace vpdr::vision
