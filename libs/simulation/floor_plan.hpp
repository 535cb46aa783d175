#pragma once
// The inside of a building: corridors, rooms and treads of stairs as axis-aligned rectangles, each
// with a floor and a ceiling, whose union is free space; the walls around it, and how far a line of
// sight reaches. No place lies above another. World ENU, metres.
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace vpdr::simulation {

struct Rectangle {
  Eigen::Vector2d min_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d max_m = Eigen::Vector2d::Zero();
  double floor_m = 0.0;
  double height_m = 0.0;  ///< from floor to ceiling; 0: the plan's own
};

/// A straight wall. Seen from the corridor, `start_m` is at its left end.
struct Wall {
  Eigen::Vector2d start_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d end_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();  ///< into the corridor, unit
  double floor_m = 0.0;
  double height_m = 0.0;

  [[nodiscard]] double length_m() const { return (end_m - start_m).norm(); }
};

/// Where free space goes on at another level: one can pass from `low_m` to `high_m`; below is the
/// riser of a step, above the lintel.
struct Opening {
  int axis = 0;  ///< 0: it is crossed along x, 1: along y
  double low_m = 0.0;
  double high_m = 0.0;
};

/// Where a level line of sight ends.
struct WallHit {
  int wall = -1;          ///< index into walls(); -1: no start in free space
  double distance = 0.0;  ///< in lengths of the direction given
};

/// Where a line of sight ends.
struct Sight {
  enum class Kind : std::uint8_t { kFloor, kCeiling, kWall, kStep };
  Kind kind = Kind::kFloor;
  int index = -1;         ///< into walls() or openings()
  int cell = -1;          ///< of free space in which it ends
  float distance = 0.0F;  ///< in lengths of the direction given
};

/// Level and sides of a cell of free space; sides without a wall are far away.
struct Cell {
  float floor_m = 0.0F, ceiling_m = 0.0F;
  float west_m = 0.0F, east_m = 0.0F, south_m = 0.0F, north_m = 0.0F;
};

/// Thread-safe once made.
class FloorPlan {
 public:
  /// Where rectangles overlap, the lowest floor and the highest ceiling count. Throws
  /// ConfigurationFault when there is no corridor or one has no width.
  explicit FloorPlan(std::vector<Rectangle> corridors, double ceiling_m = 2.7);

  [[nodiscard]] const std::vector<Rectangle>& corridors() const { return corridors_; }
  [[nodiscard]] const std::vector<Wall>& walls() const { return walls_; }
  [[nodiscard]] const std::vector<Opening>& openings() const { return openings_; }
  /// Height of a corridor that has none of its own.
  [[nodiscard]] double ceiling_m() const { return ceiling_m_; }
  /// Smallest rectangle around all corridors.
  [[nodiscard]] Rectangle bounds() const;

  /// True where a person can stand.
  [[nodiscard]] bool contains(const Eigen::Vector2d& point_m) const;
  /// Distance to the nearest wall, negative outside the corridors.
  [[nodiscard]] double clearance_m(const Eigen::Vector2d& point_m) const;
  /// The cell of free space that holds a point, -1 for none.
  [[nodiscard]] int cell_at(const Eigen::Vector2d& point_m) const;
  /// The first wall along a level `direction` (any length but zero), by walking from cell to cell
  /// (Amanatides and Woo 1987, on a grid with lines where corridors begin and end).
  [[nodiscard]] WallHit cast(const Eigen::Vector2d& origin_m,
                             const Eigen::Vector2d& direction) const;
  /// The first surface along a direction from a place inside a cell, in single precision.
  [[nodiscard]] Sight follow(int cell, const Eigen::Vector3f& origin_m,
                             const Eigen::Vector3f& direction) const;
  [[nodiscard]] const Cell& cell(int index) const {
    return cells_[static_cast<std::size_t>(index)];
  }

 private:
  [[nodiscard]] bool is_free(int column, int row) const;
  [[nodiscard]] int& wall_left_of(int column, int row);
  [[nodiscard]] int& wall_below(int column, int row);
  void find_cells();
  void find_walls_along_y();
  void find_walls_along_x();
  void add_wall_piece(int& slot, int previous, Wall piece, int cell);
  [[nodiscard]] int opening_between(int a, int b, int axis);
  void find_sides();

  std::vector<Rectangle> corridors_;
  double ceiling_m_;
  std::vector<double> xs_, ys_;  ///< grid lines
  int columns_ = 0, rows_ = 0;
  std::vector<float> xs_near_, ys_near_;  ///< the same in single precision
  std::vector<char> free_;                ///< cells, row by row
  std::vector<Cell> cells_;               ///< one column more than free_
  /// On the left and lower side of each cell: a wall, -1 for none, or -2 less an opening.
  std::vector<int> left_, below_;
  std::vector<Wall> walls_;
  std::vector<Opening> openings_;
};

}  // namespace vpdr::simulation
