#include "evaluation/trajectory_errors.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "evaluation/interpolation.hpp"

namespace vpdr::evaluation {
namespace {

/// The reference's jitter below this is no walking.
constexpr double kShortestMoveM = 0.05;
constexpr double kSegmentM = 10.0;
constexpr double kShortestSegmentM = 1.0;
/// Segments start this often along the path, in parts of a segment.
constexpr double kSegmentStride = 0.1;
/// Keeps the ellipse of an estimate that is sure of its start from having no area.
constexpr double kSmallestVarianceM2 = 1e-6;

/// Horizontal length of the reference path up to each pair.
std::vector<double> path_lengths(const std::vector<PositionPair>& pairs) {
  std::vector<double> lengths;
  double length = 0.0;
  Eigen::Vector2d last = pairs.front().truth_m.head<2>();
  for (const PositionPair& pair : pairs) {
    const double moved = (pair.truth_m.head<2>() - last).norm();
    if (moved >= kShortestMoveM) {
      length += moved;
      last = pair.truth_m.head<2>();
    }
    lengths.push_back(length);
  }
  return lengths;
}

double ate(const std::vector<PositionPair>& pairs, const YawAlignment& alignment) {
  double sum = 0.0;
  for (const PositionPair& pair : pairs) {
    sum += (alignment.apply(pair.estimate_m) - pair.truth_m).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(pairs.size()));
}

std::optional<double> rpe(const std::vector<PositionPair>& pairs, const YawAlignment& alignment,
                          const std::vector<double>& lengths, double segment_m) {
  if (segment_m < kShortestSegmentM) return std::nullopt;
  double sum = 0.0;
  double segments = 0.0;
  double next_start_m = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (lengths[i] < next_start_m) continue;
    const auto end = std::lower_bound(lengths.begin(), lengths.end(), lengths[i] + segment_m);
    if (end == lengths.end()) break;
    const auto j = static_cast<std::size_t>(end - lengths.begin());
    const Eigen::Vector3d estimated =
        alignment.apply(pairs[j].estimate_m) - alignment.apply(pairs[i].estimate_m);
    const Eigen::Vector3d moved = pairs[j].truth_m - pairs[i].truth_m;
    sum += (estimated - moved).norm() / (lengths[j] - lengths[i]);
    segments += 1.0;
    next_start_m = lengths[i] + kSegmentStride * segment_m;
  }
  if (segments == 0.0) return std::nullopt;
  return 100.0 * sum / segments;
}

/// Horizontal error vectors once the estimate stands on the reference's start.
std::vector<Eigen::Vector2d> start_aligned(const std::vector<PositionPair>& pairs) {
  const Eigen::Vector3d shift = pairs.front().truth_m - pairs.front().estimate_m;
  std::vector<Eigen::Vector2d> errors;
  errors.reserve(pairs.size());
  for (const PositionPair& pair : pairs) {
    errors.push_back((pair.estimate_m + shift - pair.truth_m).head<2>());
  }
  return errors;
}

StartAlignedErrors summarize(const std::vector<Eigen::Vector2d>& errors, double path_m) {
  StartAlignedErrors summary;
  for (const Eigen::Vector2d& error : errors) {
    summary.mean_m += error.norm() / static_cast<double>(errors.size());
    summary.max_m = std::max(summary.max_m, error.norm());
  }
  summary.final_m = errors.back().norm();
  summary.final_percent = path_m > 0.0 ? 100.0 * summary.final_m / path_m : 0.0;
  return summary;
}

double inside_95_percent(const std::vector<PositionPair>& pairs,
                         const std::vector<Eigen::Vector2d>& errors,
                         const std::vector<StampedCovariance>& covariance) {
  std::size_t inside = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Eigen::Matrix2d p = covariance_at(covariance, pairs[i].stamp_ns).position_m2 +
                              kSmallestVarianceM2 * Eigen::Matrix2d::Identity();
    if (errors[i].dot(p.inverse() * errors[i]) <= kChiSquare95TwoDof) ++inside;
  }
  return 100.0 * static_cast<double>(inside) / static_cast<double>(pairs.size());
}

}  // namespace

std::vector<PositionPair> position_pairs(const std::vector<StampedPose>& estimate,
                                         const std::vector<dataset::TruthPose>& truth) {
  std::vector<PositionPair> pairs;
  if (estimate.empty()) return pairs;
  for (const dataset::TruthPose& pose : truth) {
    if (!pose.has_position() || pose.stamp_ns < estimate.front().stamp_ns ||
        pose.stamp_ns > estimate.back().stamp_ns) {
      continue;
    }
    pairs.push_back({pose.stamp_ns, position_at(estimate, pose.stamp_ns), pose.position_m});
  }
  return pairs;
}

Eigen::Vector3d YawAlignment::apply(const Eigen::Vector3d& point_m) const {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * point_m + translation_m;
}

YawAlignment align_yaw(const std::vector<PositionPair>& pairs) {
  Eigen::Vector3d mean_estimate = Eigen::Vector3d::Zero();
  Eigen::Vector3d mean_truth = Eigen::Vector3d::Zero();
  const auto n = static_cast<double>(pairs.size());
  for (const PositionPair& pair : pairs) {
    mean_estimate += pair.estimate_m / n;
    mean_truth += pair.truth_m / n;
  }
  double dot = 0.0;
  double cross = 0.0;
  for (const PositionPair& pair : pairs) {
    const Eigen::Vector3d e = pair.estimate_m - mean_estimate;
    const Eigen::Vector3d t = pair.truth_m - mean_truth;
    dot += e.x() * t.x() + e.y() * t.y();
    cross += e.x() * t.y() - e.y() * t.x();
  }
  YawAlignment alignment;
  alignment.yaw_rad = std::atan2(cross, dot);
  alignment.translation_m = mean_truth - alignment.apply(mean_estimate);
  return alignment;
}

std::optional<PositionErrors> position_errors(const RunDirectory& run,
                                              const dataset::Truth& truth) {
  const std::vector<PositionPair> pairs = position_pairs(run.fused, truth.poses);
  if (pairs.size() < 2) return std::nullopt;
  const YawAlignment alignment = align_yaw(pairs);
  const std::vector<double> lengths = path_lengths(pairs);
  const std::vector<Eigen::Vector2d> errors = start_aligned(pairs);
  PositionErrors result;
  result.poses = pairs.size();
  result.path_m = lengths.back();
  result.ate_m = ate(pairs, alignment);
  result.segment_m = std::min(kSegmentM, result.path_m / 2.0);
  result.rpe_percent = rpe(pairs, alignment, lengths, result.segment_m);
  result.start_aligned = summarize(errors, result.path_m);
  if (!run.covariance.empty()) {
    result.inside_95_percent = inside_95_percent(pairs, errors, run.covariance);
  }
  return result;
}

}  // namespace vpdr::evaluation
