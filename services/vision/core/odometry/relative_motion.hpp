#pragma once
// How a camera moved between two frames, from points that both see (S1.8): rotation, direction of
// the movement, and which model explains the points best. The length of the movement is not to be
// seen in two frames. Camera axes: x right, y down, z forward; radians.
//
// Models: rotation only; essential matrix, by the five-point problem solved with Gauss-Newton
// (Sarkis, Diepold and Hueper 2007), or with two points where a gyroscope gives the rotation;
// homography, for scenes that are one plane (Ma, Soatto, Kosecka and Sastry 2004, 5.3). Samples are
// scored by MSAC, models compared by GRIC (Torr 1998). Random choices come from a fixed seed, so
// equal points give equal answers. Not thread-safe; allocates nothing once its buffers have grown.
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "vision/core/odometry/plane_motion.hpp"

namespace vpdr::vision {

enum class MotionModel : std::uint8_t { kNone, kRotation, kEssential, kHomography };

/// What a gyroscope says of the rotation.
struct RotationPrior {
  Eigen::Matrix3d earlier_from_later = Eigen::Matrix3d::Identity();
  double sigma_rad = 0.01;  ///< about each axis
};

struct RelativeMotion {
  MotionModel model = MotionModel::kNone;  ///< kNone: the points agree on no motion
  Eigen::Matrix3d earlier_from_later = Eigen::Matrix3d::Identity();
  /// Unit vector of the camera's movement in the earlier camera's axes; zero for kRotation.
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  /// Rotation vector (earlier axes) and direction, 3 + 3.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
  std::size_t inliers = 0;
  double parallax_rad = 0.0;  ///< median over the inliers: what is left of the rays' angle when the
                              ///< rotation is undone
};

struct RelativeMotionConfig {
  int samples = 120;            ///< tried for each model
  double inlier_sigmas = 3.0;   ///< a point within is explained
  std::size_t min_points = 12;  ///< fewer tell nothing
  double min_inlier_share = 0.5;
  int refinements = 8;  ///< Gauss-Newton steps at the end
};

class RelativeMotionEstimator {
 public:
  explicit RelativeMotionEstimator(const RelativeMotionConfig& config = {}) : config_(config) {}

  /// `ray_sigma_rad`: uncertainty of a ray across each of two directions.
  RelativeMotion estimate(const std::vector<RayPair>& pairs, double ray_sigma_rad,
                          const std::optional<RotationPrior>& prior);

 private:
  struct Hypothesis {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< earlier from later
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();
    double cost = 0.0;  ///< truncated sum of squares, in sigmas
  };
  Hypothesis find_rotation(const std::optional<RotationPrior>& prior);
  Hypothesis find_essential(const Hypothesis& turned, bool rotation_known);
  std::optional<Hypothesis> find_homography(const Hypothesis& turned);
  [[nodiscard]] Eigen::Matrix3d refined_homography(const Eigen::Matrix3d& start) const;
  void refine(Hypothesis& hypothesis, const std::optional<RotationPrior>& prior,
              RelativeMotion* out) const;
  void refine_rotation(Hypothesis& hypothesis, const std::optional<RotationPrior>& prior,
                       RelativeMotion* out) const;
  [[nodiscard]] bool solve_five(const std::size_t (&chosen)[5], Hypothesis& h) const;
  [[nodiscard]] double rotation_cost(const Eigen::Matrix3d& rotation) const;
  [[nodiscard]] double epipolar_cost(const Hypothesis& h) const;
  [[nodiscard]] double homography_cost(const Eigen::Matrix3d& later_from_earlier) const;
  void face_forward(Hypothesis& h) const;
  void describe(const Hypothesis& h, RelativeMotion& out);
  template <std::size_t kCount>
  void choose(std::size_t (&chosen)[kCount]);
  std::uint64_t random();

  RelativeMotionConfig config_;
  const std::vector<RayPair>* pairs_ = nullptr;
  double sigma_rad_ = 0.0;
  std::uint64_t random_state_ = 0;
  std::vector<double> parallax_;
};

}  // namespace vpdr::vision
