#pragma once
// The corridor's three directions as one rotation, and its refinement on line segments.
// Camera axes: x right, y down, z forward. Radians. Pure functions, thread-safe, no allocation.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "vision/core/heading/line_segments.hpp"

namespace vpdr::vision {

/// The vertical in camera axes, as the inertial attitude (or mere belief) knows it.
struct VerticalPrior {
  Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
  double sigma_rad = 0.03;  ///< of each of its two tilts
};

/// What the segments say of the building's directions.
struct ManhattanFrame {
  Eigen::Matrix3d camera_from_corridor = Eigen::Matrix3d::Identity();  ///< forward, left, up
  Eigen::Matrix3d covariance_rad2 = Eigen::Matrix3d::Zero();  ///< of a small turn, camera axes
  std::array<std::uint32_t, 3> inliers{};                     ///< along forward, left, up
  std::array<double, 3> support{};  ///< their summed weight, 1 = one image diagonal of segments
  double unexplained = 0.0;         ///< summed weight of the segments along none of the three
  double contrast = 0.0;  ///< score of the best yaw over the mean over all yaws; set by the search
};

struct RefineConfig {
  double inlier_angle_rad = 0.035;  ///< between a segment and the line to its vanishing point
  double model_sigma_rad = 0.006;   ///< how far edges of a building are from its three directions
  int iterations = 10;
};

/// Square of the sine of the angle, at the segment's middle, between the segment and the line that
/// leads to the vanishing point of `direction`.
inline double squared_sine_to(const SphereSegment& s, const Eigen::Vector3d& direction) {
  const double off = s.normal.dot(direction);
  const double with = s.along.dot(direction);
  const double sum = off * off + with * with;
  return sum > 1e-12 ? off * off / sum : 1.0;
}

/// Index of the direction (column) that the segment points to within `limit_rad`; nothing where it
/// points to none.
std::optional<int> direction_of(const SphereSegment& segment, const Eigen::Matrix3d& directions,
                                double limit_rad);

/// Maximum a posteriori rotation: each segment is given to the direction it points to best; its
/// residual is normal . direction (zero for a segment that points to the vanishing point), against
/// the standard deviation that follows from the segment's end points; Tukey weights on the angle;
/// Gauss-Newton on a small turn d in camera axes, R <- exp(d) R. Counts, support and covariance
/// (the larger of inverse information and White's covariance from the residuals) are filled in.
ManhattanFrame refine_frame(const std::vector<SphereSegment>& segments,
                            const Eigen::Matrix3d& start, const VerticalPrior& prior,
                            const RefineConfig& config);

struct FreeConfig {
  double orthogonality_sigma_rad = 0.02;  ///< belief in each direction's place in the frame
  int iterations = 5;
};

/// One direction, not bound to be perpendicular to the others.
struct FreeDirection {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  double variance_rad2 = 0.0;  ///< of its angle: both ways across it added
};

/// The three directions each for itself, for walls are not quite square and lenses not quite
/// calibrated: each one by its own segments, with its place in `frame` as a prior.
std::array<FreeDirection, 3> free_directions(const std::vector<SphereSegment>& segments,
                                             const Eigen::Matrix3d& frame,
                                             const RefineConfig& refine, const FreeConfig& config);

/// The same building directions, named so that forward is the horizontal one nearest to the
/// optical axis.
ManhattanFrame face_forward(const ManhattanFrame& frame);

}  // namespace vpdr::vision
