#pragma once
// The main vanishing point on the calibrated unit sphere: the corridor's direction, its
// perpendicular and the vertical are searched together, as one rotation, without any random
// choice, so that the same segments always give the same answer.
//
// With the vertical known (from the inertial attitude) one number is left, the yaw of the corridor
// modulo 90 degrees: all yaws are tried and the best few refined. Without it, candidate verticals
// on a grid of roll and pitch are tried, each with its best yaw from a histogram of the segments'
// votes: the plane of a segment with normal n meets the horizontal plane in n x up.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vision/core/heading/line_segments.hpp"
#include "vision/core/heading/manhattan_frame.hpp"

namespace vpdr::vision {

struct SearchConfig {
  RefineConfig refine;
  double vertical_angle_rad = 0.087;  ///< segments this close to the vertical have no say on yaw
  double max_roll_rad = 0.45;         ///< grid without a prior: how far from upright
  double max_pitch_rad = 0.60;
  double grid_step_rad = 0.05;
  double roll_sigma_rad = 0.15;  ///< belief, without a prior, that the camera is upright
  double pitch_sigma_rad = 0.30;
};

/// Not thread-safe: keeps its buffers, so that a search allocates nothing once warm.
class ManhattanSearch {
 public:
  explicit ManhattanSearch(const SearchConfig& config) : config_(config) {}

  /// The best frame, forward being the horizontal direction nearest to the optical axis; nothing
  /// when there are fewer than three segments or the camera looks straight up or down. Without a
  /// prior, `usual_up` is tried besides the grid: the vertical of the frame before, say.
  std::optional<ManhattanFrame> search(const std::vector<SphereSegment>& segments,
                                       const std::optional<VerticalPrior>& prior,
                                       const Eigen::Vector3d& usual_up = -Eigen::Vector3d::UnitY());

 private:
  struct Candidate {
    Eigen::Vector3d up = -Eigen::Vector3d::UnitY();
    double yaw_rad = 0.0;  ///< of a building direction, from the optical axis, about `up`
    double score = 0.0;
  };
  struct Best {
    std::optional<ManhattanFrame> frame;
    double score = 0.0;
  };
  struct LevelSegment {  ///< parts of normal and along in the horizontal plane
    double normal_forward, normal_left, along_forward, along_left, weight;
  };

  double score_yaws(const std::vector<SphereSegment>& segments, const Eigen::Matrix3d& axes,
                    double inlier_angle_rad);
  void propose_yaws(const std::vector<SphereSegment>& segments, const Eigen::Vector3d& up);
  void propose_verticals(const std::vector<SphereSegment>& segments);
  [[nodiscard]] Candidate vote(const std::vector<SphereSegment>& segments,
                               const Eigen::Vector3d& up);
  void keep_best_apart();
  void refine_candidates(const std::vector<SphereSegment>& segments,
                         const std::optional<VerticalPrior>& prior, Best& best);

  SearchConfig config_;
  std::vector<LevelSegment> level_;
  std::vector<double> votes_;
  std::vector<Candidate> candidates_;
};

}  // namespace vpdr::vision
