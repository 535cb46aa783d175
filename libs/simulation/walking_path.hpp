#pragma once
// The line a person walks on the floor: straight legs and turns whose curvature grows and falls
// smoothly, as in human locomotion. World east-north, metres, yaw 0 = east, counter-clockwise.
#include <Eigen/Core>
#include <vector>

namespace vpdr::simulation {

struct PathPoint {
  Eigen::Vector2d position_m = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;  ///< unwrapped along the path
  double curvature_per_m = 0.0;
};

/// A polyline with its corners rounded. A turn spreads over `turn_length_m` of the way, less where
/// the legs are short. Turns back (more than 135 degrees) become two quarter turns side by side.
/// Thread-safe once made.
class WalkingPath {
 public:
  /// At least two corners, neighbours apart; throws ConfigurationFault otherwise.
  explicit WalkingPath(const std::vector<Eigen::Vector2d>& corners_m, double turn_length_m = 2.6);

  [[nodiscard]] double length_m() const { return length_m_; }
  /// The point `s_m` along the path, clamped to its ends.
  [[nodiscard]] PathPoint at(double s_m) const;

 private:
  struct Piece {
    double start_m;  ///< along the path
    double length_m;
    Eigen::Vector2d position_m;
    double heading_rad;
    double turn_rad;  ///< 0 for a straight leg
  };

  void append(double length_m, double turn_rad);
  static PathPoint evaluate(const Piece& piece, double along_m);

  std::vector<Piece> pieces_;
  double length_m_ = 0.0;
};

}  // namespace vpdr::simulation
