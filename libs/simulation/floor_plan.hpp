#pragma once
// The floor of a building: corridors as axis-aligned rectangles whose union is free space, the
// walls around it, and how far a line of sight reaches. World ENU, metres, floor at z = 0.
#include <Eigen/Core>
#include <vector>

namespace vpdr::simulation {

struct Rectangle {
  Eigen::Vector2d min_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d max_m = Eigen::Vector2d::Zero();
};

/// A straight wall. Seen from the corridor, `start_m` is at its left end.
struct Wall {
  Eigen::Vector2d start_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d end_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< into the corridor, unit

  [[nodiscard]] double length_m() const { return (end_m - start_m).norm(); }
};

/// Where a line of sight ends.
struct WallHit {
  int wall = -1;  ///< index into walls(); -1: none before the limit, or no start in free space
  double distance = 0.0;  ///< in lengths of the direction given
  int cell = -1;          ///< of free space where it ends
};

/// Thread-safe once made.
class FloorPlan {
 public:
  /// Throws ConfigurationFault when there is no corridor or one has no width.
  explicit FloorPlan(std::vector<Rectangle> corridors, double ceiling_m = 2.7);

  [[nodiscard]] const std::vector<Rectangle>& corridors() const { return corridors_; }
  [[nodiscard]] const std::vector<Wall>& walls() const { return walls_; }
  [[nodiscard]] double ceiling_m() const { return ceiling_m_; }
  /// Smallest rectangle around all corridors.
  [[nodiscard]] Rectangle bounds() const;

  /// True where a person can stand.
  [[nodiscard]] bool contains(const Eigen::Vector2d& point_m) const;
  /// Distance to the nearest wall, negative outside the corridors.
  [[nodiscard]] double clearance_m(const Eigen::Vector2d& point_m) const;
  /// The cell of free space that holds a point, -1 for none.
  [[nodiscard]] int cell_at(const Eigen::Vector2d& point_m) const;
  /// The first wall along `direction` (any length but zero), by walking from cell to cell
  /// (Amanatides and Woo 1987, on a grid with lines where corridors begin and end).
  [[nodiscard]] WallHit cast(const Eigen::Vector2d& origin_m,
                             const Eigen::Vector2d& direction) const;
  /// The same from a cell that is known, -1 giving no hit, and up to `limit` lengths of direction.
  [[nodiscard]] WallHit cast_from(int cell, const Eigen::Vector2d& origin_m,
                                  const Eigen::Vector2d& direction, double limit) const;
  /// Distance along x and along y to the walls at the sides of a point's cell; large where there
  /// is none.
  [[nodiscard]] Eigen::Vector2d edge_distance_m(int cell, const Eigen::Vector2d& point_m) const;

 private:
  [[nodiscard]] bool is_free(int column, int row) const;
  [[nodiscard]] int& wall_left_of(int column, int row);
  [[nodiscard]] int& wall_below(int column, int row);
  void find_walls_along_y();
  void find_walls_along_x();
  void add_wall_piece(int& slot, int previous, const Wall& piece);

  std::vector<Rectangle> corridors_;
  double ceiling_m_;
  std::vector<double> xs_, ys_;  ///< grid lines
  int columns_ = 0, rows_ = 0;
  std::vector<char> free_;         ///< cells, row by row
  std::vector<int> left_, below_;  ///< wall on the left and lower side of each cell, or -1
  std::vector<Wall> walls_;
};

}  // namespace vpdr::simulation
