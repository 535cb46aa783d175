#pragma once
// Position errors against reference poses, at the reference's stamps inside the estimate's span.
//
// ATE: root mean square of the distance after the best rotation about the vertical and the best
// translation (4 degrees of freedom: gravity is observed, yaw and position are not; Zhang and
// Scaramuzza, "A Tutorial on Quantitative Trajectory Evaluation", IROS 2018, sections IV and V).
// RPE: over segments of the reference path of fixed length, the distance between estimated and true
// displacement after that same rotation, in percent of the segment's length; their mean.
// Start-aligned: horizontal distance after moving the estimate to the reference's start, no
// rotation.
#include <optional>
#include <vector>

#include "dataset/recording.hpp"
#include "evaluation/run_directory.hpp"

namespace vpdr::evaluation {

/// 95 % quantile of the chi-squared distribution with two degrees of freedom.
inline constexpr double kChiSquare95TwoDof = 5.991464547107979;

/// A place at an instant, estimated and true.
struct PositionPair {
  TimestampNs stamp_ns = 0;
  Eigen::Vector3d estimate_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d truth_m = Eigen::Vector3d::Zero();
};

/// Pairs at every reference pose with a known position within the estimate's span.
std::vector<PositionPair> position_pairs(const std::vector<StampedPose>& estimate,
                                         const std::vector<dataset::TruthPose>& truth);

/// Rotation about the vertical, then translation: truth = Rz(yaw) estimate + translation.
struct YawAlignment {
  double yaw_rad = 0.0;
  Eigen::Vector3d translation_m = Eigen::Vector3d::Zero();
  [[nodiscard]] Eigen::Vector3d apply(const Eigen::Vector3d& point_m) const;
};

/// Least squares over the pairs (closed form). `pairs` must not be empty.
YawAlignment align_yaw(const std::vector<PositionPair>& pairs);

struct StartAlignedErrors {
  double mean_m = 0.0;
  double max_m = 0.0;
  double final_m = 0.0;
  double final_percent = 0.0;  ///< of the path's length
};

struct PositionErrors {
  double ate_m = 0.0;
  std::optional<double> rpe_percent;  ///< nullopt where the path is too short for a segment
  double segment_m = 0.0;             ///< length of the RPE's segments
  double path_m = 0.0;                ///< horizontal length of the reference path
  StartAlignedErrors start_aligned;
  /// Share of the reference positions inside the estimate's 95 % ellipse, start-aligned; nullopt
  /// without covariances.
  std::optional<double> inside_95_percent;
  std::uint64_t poses = 0;
};

/// nullopt where fewer than two positions can be compared.
std::optional<PositionErrors> position_errors(const RunDirectory& run, const dataset::Truth& truth);

}  // namespace vpdr::evaluation
