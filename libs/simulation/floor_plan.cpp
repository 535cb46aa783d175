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
using Eigen::Vector3f;

constexpr int kNothing = -1;  // in a slot for a wall; below it are openings
constexpr int kFirstOpening = -2;

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
  xs_near_.assign(xs_.begin(), xs_.end());
  ys_near_.assign(ys_.begin(), ys_.end());
  columns_ = static_cast<int>(xs_.size()) - 1;
  rows_ = static_cast<int>(ys_.size()) - 1;
  const auto sides = grid_index(0, rows_ + 1, columns_ + 1);
  cells_.resize(sides);
  left_.assign(sides, kNothing);
  below_.assign(sides, kNothing);
  find_cells();
  find_walls_along_y();
  find_walls_along_x();
  find_sides();
}

void FloorPlan::find_cells() {
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const auto x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row);
      const Vector2d centre(0.5 * (xs_[x] + xs_[x + 1]), 0.5 * (ys_[y] + ys_[y + 1]));
      Cell& cell = cells_[grid_index(column, row, columns_ + 1)];
      bool is_inside = false;
      for (const Rectangle& c : corridors_) {
        if ((centre - c.min_m).minCoeff() <= 0.0 || (c.max_m - centre).minCoeff() <= 0.0) continue;
        const auto floor = static_cast<float>(c.floor_m);
        const float top = floor + static_cast<float>(c.height_m > 0.0 ? c.height_m : ceiling_m_);
        cell.floor_m = is_inside ? std::min(cell.floor_m, floor) : floor;
        cell.ceiling_m = is_inside ? std::max(cell.ceiling_m, top) : top;
        is_inside = true;
      }
      free_.push_back(is_inside ? 1 : 0);
    }
  }
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

void FloorPlan::add_wall_piece(int& slot, int previous, Wall piece, int cell) {
  const Cell& inside = cells_[static_cast<std::size_t>(cell)];
  piece.floor_m = inside.floor_m;
  piece.height_m = inside.ceiling_m - inside.floor_m;
  const auto goes_on = [&](const Wall& wall) {
    return wall.normal == piece.normal && wall.floor_m == piece.floor_m &&
           wall.height_m == piece.height_m;
  };
  if (previous >= 0 && goes_on(walls_[static_cast<std::size_t>(previous)])) {
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

int FloorPlan::opening_between(int a, int b, int axis) {
  const Cell &one = cells_[static_cast<std::size_t>(a)], &two = cells_[static_cast<std::size_t>(b)];
  if (one.floor_m == two.floor_m && one.ceiling_m == two.ceiling_m) return kNothing;
  openings_.push_back(
      {axis, std::max(one.floor_m, two.floor_m), std::min(one.ceiling_m, two.ceiling_m)});
  return kFirstOpening - static_cast<int>(openings_.size() - 1);
}

void FloorPlan::find_walls_along_y() {
  for (int column = 0; column <= columns_; ++column) {
    int previous = kNothing;
    for (int row = 0; row < rows_; ++row) {
      const bool free_left = is_free(column - 1, row), free_right = is_free(column, row);
      const int here = static_cast<int>(grid_index(column, row, columns_ + 1));
      if (free_left == free_right) {
        previous = kNothing;
        if (free_left) wall_left_of(column, row) = opening_between(here - 1, here, 0);
        continue;
      }
      const double x = xs_[static_cast<std::size_t>(column)];
      const Vector2d low(x, ys_[static_cast<std::size_t>(row)]);
      const Vector2d high(x, ys_[static_cast<std::size_t>(row) + 1]);
      const Wall piece =
          free_left ? Wall{high, low, -Vector2d::UnitX()} : Wall{low, high, Vector2d::UnitX()};
      add_wall_piece(wall_left_of(column, row), previous, piece, free_left ? here - 1 : here);
      previous = wall_left_of(column, row);
    }
  }
}

void FloorPlan::find_walls_along_x() {
  for (int row = 0; row <= rows_; ++row) {
    int previous = kNothing;
    for (int column = 0; column < columns_; ++column) {
      const bool free_below = is_free(column, row - 1), free_above = is_free(column, row);
      const int here = static_cast<int>(grid_index(column, row, columns_ + 1));
      const int below = here - columns_ - 1;
      if (free_below == free_above) {
        previous = kNothing;
        if (free_below) wall_below(column, row) = opening_between(below, here, 1);
        continue;
      }
      const double y = ys_[static_cast<std::size_t>(row)];
      const Vector2d low(xs_[static_cast<std::size_t>(column)], y);
      const Vector2d high(xs_[static_cast<std::size_t>(column) + 1], y);
      const Wall piece =
          free_below ? Wall{low, high, -Vector2d::UnitY()} : Wall{high, low, Vector2d::UnitY()};
      add_wall_piece(wall_below(column, row), previous, piece, free_below ? below : here);
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
  const int cell = cell_at(origin_m);
  if (cell < 0) return {};
  const int stride = columns_ + 1;
  int column = cell % stride;
  int row = cell / stride;
  const int right = direction.x() > 0.0 ? 1 : 0;
  const int up = direction.y() > 0.0 ? 1 : 0;
  constexpr double kNever = std::numeric_limits<double>::infinity();
  while (true) {
    // The grid lines that the ray crosses next.
    const double x = xs_[grid_index(column + right, 0, stride)];
    const double y = ys_[grid_index(row + up, 0, stride)];
    const double to_x = direction.x() != 0.0 ? (x - origin_m.x()) / direction.x() : kNever;
    const double to_y = direction.y() != 0.0 ? (y - origin_m.y()) / direction.y() : kNever;
    if (to_x <= to_y) {
      const int wall = left_[grid_index(column + right, row, stride)];
      if (wall >= 0) return {wall, to_x};
      column += 2 * right - 1;
    } else {
      const int wall = below_[grid_index(column, row + up, stride)];
      if (wall >= 0) return {wall, to_y};
      row += 2 * up - 1;
    }
  }
}

Sight FloorPlan::follow(int cell, const Vector3f& origin_m, const Vector3f& direction) const {
  // A direction along an axis never reaches the lines along it: as good as very slowly.
  const auto per = [](float d) {
    return std::abs(d) > 1e-12F ? 1.0F / d : (d > 0.0F ? 1e12F : -1e12F);
  };
  const float per_x = per(direction.x()), per_y = per(direction.y()), per_z = per(direction.z());
  const int right = direction.x() > 0.0F ? 1 : 0, up = direction.y() > 0.0F ? 1 : 0;
  const bool rises = direction.z() > 0.0F;
  const int stride = columns_ + 1;
  int column = cell % stride, row = cell / stride;
  const auto at = [](int index) { return static_cast<std::size_t>(index); };
  const float* x_line = &xs_near_[at(column + right)];
  const float* y_line = &ys_near_[at(row + up)];
  float to_x = (*x_line - origin_m.x()) * per_x, to_y = (*y_line - origin_m.y()) * per_y;
  while (true) {
    const Cell& here = cells_[at(cell)];
    const float to_level = ((rises ? here.ceiling_m : here.floor_m) - origin_m.z()) * per_z;
    if (to_level <= std::min(to_x, to_y)) {
      return {rises ? Sight::Kind::kCeiling : Sight::Kind::kFloor, -1, cell, to_level};
    }
    const bool along_x = to_x <= to_y;
    const float to_side = along_x ? to_x : to_y;
    const int slot = along_x ? left_[at(cell + right)] : below_[at(cell + up * stride)];
    if (slot >= 0) return {Sight::Kind::kWall, slot, cell, to_side};
    if (slot <= kFirstOpening) {
      const Opening& opening = openings_[static_cast<std::size_t>(kFirstOpening - slot)];
      const double z = origin_m.z() + to_side * direction.z();
      if (z < opening.low_m || z > opening.high_m) {
        return {Sight::Kind::kStep, kFirstOpening - slot, cell, to_side};
      }
    }
    if (along_x) {
      cell += 2 * right - 1;
      x_line += 2 * right - 1;
      to_x = (*x_line - origin_m.x()) * per_x;
    } else {
      cell += (2 * up - 1) * stride;
      y_line += 2 * up - 1;
      to_y = (*y_line - origin_m.y()) * per_y;
    }
  }
}

void FloorPlan::find_sides() {
  constexpr float kFar = 1e3F;
  const int stride = columns_ + 1;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const auto c = grid_index(column, row, stride), above = grid_index(column, row + 1, stride);
      const auto x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row);
      Cell& cell = cells_[c];
      cell.west_m = left_[c] >= 0 ? xs_near_[x] : -kFar;
      cell.east_m = left_[c + 1] >= 0 ? xs_near_[x + 1] : kFar;
      cell.south_m = below_[c] >= 0 ? ys_near_[y] : -kFar;
      cell.north_m = below_[above] >= 0 ? ys_near_[y + 1] : kFar;
    }
  }
}

}  // namespace vpdr::simulation
