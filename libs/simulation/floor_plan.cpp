#include "simulation/floor_plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/errors.hpp"
#include "simulation/grid_index.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;

std::vector<double> grid_lines(const std::vector<Rectangle>& corridors, int axis) {
  std::vector<double> lines;
  for (const Rectangle& corridor : corridors) {
    lines.push_back(corridor.min_m[axis]);
    lines.push_back(corridor.max_m[axis]);
  }
  std::sort(lines.begin(), lines.end());
  const auto same = [](double a, double b) { return b - a < 1e-9; };
  lines.erase(std::unique(lines.begin(), lines.end(), same), lines.end());
  return lines;
}

/// Index of the cell that holds `value`, or -1.
int cell_of(const std::vector<double>& lines, double value) {
  if (!(value >= lines.front()) || !(value < lines.back())) return -1;
  return static_cast<int>(std::upper_bound(lines.begin(), lines.end(), value) - lines.begin()) - 1;
}

}  // namespace

FloorPlan::FloorPlan(std::vector<Rectangle> corridors, double ceiling_m)
    : corridors_(std::move(corridors)), ceiling_m_(ceiling_m) {
  if (corridors_.empty()) throw ConfigurationFault("floor plan: has no corridor");
  for (const Rectangle& c : corridors_) {
    if (!((c.max_m - c.min_m).minCoeff() > 0.0)) {
      throw ConfigurationFault("floor plan: a corridor must be longer and wider than 0");
    }
  }
  xs_ = grid_lines(corridors_, 0);
  ys_ = grid_lines(corridors_, 1);
  columns_ = static_cast<int>(xs_.size()) - 1;
  rows_ = static_cast<int>(ys_.size()) - 1;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const auto x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row);
      const Vector2d centre(0.5 * (xs_[x] + xs_[x + 1]), 0.5 * (ys_[y] + ys_[y + 1]));
      const auto covers = [&](const Rectangle& c) {
        return (centre - c.min_m).minCoeff() > 0.0 && (c.max_m - centre).minCoeff() > 0.0;
      };
      free_.push_back(std::any_of(corridors_.begin(), corridors_.end(), covers) ? 1 : 0);
    }
  }
  const auto sides = grid_index(0, rows_ + 1, columns_ + 1);
  left_.assign(sides, -1);
  below_.assign(sides, -1);
  find_walls_along_y();
  find_walls_along_x();
}

bool FloorPlan::is_free(int column, int row) const {
  return column >= 0 && row >= 0 && column < columns_ && row < rows_ &&
         free_[grid_index(column, row, columns_)] != 0;
}

int& FloorPlan::wall_left_of(int column, int row) {
  return left_[grid_index(column, row, columns_ + 1)];
}

int& FloorPlan::wall_below(int column, int row) {
  return below_[grid_index(column, row, columns_ + 1)];
}

void FloorPlan::add_wall_piece(int& slot, int previous, const Wall& piece) {
  if (previous >= 0 && walls_[static_cast<std::size_t>(previous)].normal == piece.normal) {
    Wall& wall = walls_[static_cast<std::size_t>(previous)];
    // Pieces come in rising coordinates; a wall whose left end is the higher one grows there.
    if (wall.end_m == piece.start_m) {
      wall.end_m = piece.end_m;
    } else {
      wall.start_m = piece.start_m;
    }
    slot = previous;
    return;
  }
  slot = static_cast<int>(walls_.size());
  walls_.push_back(piece);
}

void FloorPlan::find_walls_along_y() {
  for (int column = 0; column <= columns_; ++column) {
    int previous = -1;
    for (int row = 0; row < rows_; ++row) {
      const bool free_left = is_free(column - 1, row);
      if (free_left == is_free(column, row)) {
        previous = -1;
        continue;
      }
      const double x = xs_[static_cast<std::size_t>(column)];
      const Vector2d low(x, ys_[static_cast<std::size_t>(row)]);
      const Vector2d high(x, ys_[static_cast<std::size_t>(row) + 1]);
      const Wall piece =
          free_left ? Wall{high, low, -Vector2d::UnitX()} : Wall{low, high, Vector2d::UnitX()};
      add_wall_piece(wall_left_of(column, row), previous, piece);
      previous = wall_left_of(column, row);
    }
  }
}

void FloorPlan::find_walls_along_x() {
  for (int row = 0; row <= rows_; ++row) {
    int previous = -1;
    for (int column = 0; column < columns_; ++column) {
      const bool free_below = is_free(column, row - 1);
      if (free_below == is_free(column, row)) {
        previous = -1;
        continue;
      }
      const double y = ys_[static_cast<std::size_t>(row)];
      const Vector2d low(xs_[static_cast<std::size_t>(column)], y);
      const Vector2d high(xs_[static_cast<std::size_t>(column) + 1], y);
      const Wall piece =
          free_below ? Wall{low, high, -Vector2d::UnitY()} : Wall{high, low, Vector2d::UnitY()};
      add_wall_piece(wall_below(column, row), previous, piece);
      previous = wall_below(column, row);
    }
  }
}

Rectangle FloorPlan::bounds() const {
  return {{xs_.front(), ys_.front()}, {xs_.back(), ys_.back()}};
}

bool FloorPlan::contains(const Vector2d& point_m) const {
  return is_free(cell_of(xs_, point_m.x()), cell_of(ys_, point_m.y()));
}

double FloorPlan::clearance_m(const Vector2d& point_m) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : walls_) {
    const Vector2d along = wall.end_m - wall.start_m;
    const double share =
        std::clamp((point_m - wall.start_m).dot(along) / along.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (point_m - wall.start_m - share * along).norm());
  }
  return contains(point_m) ? nearest : -nearest;
}

int FloorPlan::cell_at(const Vector2d& point_m) const {
  const int column = cell_of(xs_, point_m.x()), row = cell_of(ys_, point_m.y());
  return is_free(column, row) ? row * (columns_ + 1) + column : -1;
}

WallHit FloorPlan::cast(const Vector2d& origin_m, const Vector2d& direction) const {
  return cast_from(cell_at(origin_m), origin_m, direction, std::numeric_limits<double>::infinity());
}

WallHit FloorPlan::cast_from(int cell, const Vector2d& origin_m, const Vector2d& direction,
                             double limit) const {
  if (cell < 0) return {};
  const int stride = columns_ + 1;
  int column = cell % stride;
  int row = cell / stride;
  const int right = direction.x() > 0.0 ? 1 : 0;
  const int up = direction.y() > 0.0 ? 1 : 0;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double per_x = 1.0 / direction.x();
  const double per_y = 1.0 / direction.y();
  while (true) {
    // The grid lines that the ray crosses next.
    const auto x_line = grid_index(column + right, 0, stride);
    const auto y_line = grid_index(row + up, 0, stride);
    const double to_x = direction.x() != 0.0 ? (xs_[x_line] - origin_m.x()) * per_x : kNever;
    const double to_y = direction.y() != 0.0 ? (ys_[y_line] - origin_m.y()) * per_y : kNever;
    cell = row * stride + column;
    if (std::min(to_x, to_y) >= limit) return {-1, limit, cell};
    if (to_x <= to_y) {
      const int wall = left_[grid_index(column + right, row, stride)];
      if (wall >= 0) return {wall, to_x, cell};
      column += 2 * right - 1;
    } else {
      const int wall = below_[grid_index(column, row + up, stride)];
      if (wall >= 0) return {wall, to_y, cell};
      row += 2 * up - 1;
    }
  }
}

Vector2d FloorPlan::edge_distance_m(int cell, const Vector2d& point_m) const {
  constexpr double kFar = 1e3;
  const int stride = columns_ + 1;
  const auto c = static_cast<std::size_t>(cell), above = grid_index(cell, 1, stride);
  const auto x = static_cast<std::size_t>(cell % stride),
             y = static_cast<std::size_t>(cell / stride);
  const double west = left_[c] >= 0 ? point_m.x() - xs_[x] : kFar;
  const double east = left_[c + 1] >= 0 ? xs_[x + 1] - point_m.x() : kFar;
  const double south = below_[c] >= 0 ? point_m.y() - ys_[y] : kFar;
  const double north = below_[above] >= 0 ? ys_[y + 1] - point_m.y() : kFar;
  return {std::min(west, east), std::min(south, north)};
}

}  // namespace vpdr::simulation
