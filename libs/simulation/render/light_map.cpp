#include <cmath>

#include "simulation/grid_index.hpp"
#include "simulation/render/scene.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;

constexpr double kLightCellM = 0.2;
constexpr double kLightReachM = 7.0;

}  // namespace

LightMap::LightMap(const FloorPlan& plan, const std::vector<Vector2d>& lamps_m) {
  const Rectangle bounds = plan.bounds();
  x_ = static_cast<float>(bounds.min_m.x());
  y_ = static_cast<float>(bounds.min_m.y());
  const Vector2d size = bounds.max_m - bounds.min_m;
  columns_ = static_cast<int>(size.x() / kLightCellM) + 2;
  rows_ = static_cast<int>(size.y() / kLightCellM) + 2;
  values_.assign(grid_index(0, rows_, columns_), 0.0F);
  const double drop = plan.ceiling_m() - 1.0;
  const int reach = static_cast<int>(kLightReachM / kLightCellM);
  for (const Vector2d& lamp : lamps_m) {
    const int column = static_cast<int>((lamp.x() - x_) / kLightCellM);
    const int row = static_cast<int>((lamp.y() - y_) / kLightCellM);
    for (int j = std::max(0, row - reach); j < std::min(rows_, row + reach); ++j) {
      for (int i = std::max(0, column - reach); i < std::min(columns_, column + reach); ++i) {
        const Vector2d place(x_ + i * kLightCellM, y_ + j * kLightCellM);
        const Vector2d way = place - lamp;
        // A cell just behind a wall is lit too: walls take their light from the cells around.
        const double seen = plan.cast(lamp, way).distance * way.norm();
        if (way.norm() > kLightReachM || seen + 1.5 * kLightCellM < way.norm()) continue;
        const double squared = way.squaredNorm() + drop * drop;
        values_[grid_index(i, j, columns_)] +=
            static_cast<float>(drop * drop * drop / (squared * std::sqrt(squared)));
      }
    }
  }
  // Eyes and cameras take bright crossings less bright than they are.
  for (float& value : values_) value = 0.58F + 0.62F * value / (value + 0.9F);
}

float LightMap::at(float x, float y) const {
  constexpr auto kPerM = static_cast<float>(1.0 / kLightCellM);
  const float column = std::clamp((x - x_) * kPerM, 0.0F, static_cast<float>(columns_) - 1.001F);
  const float row = std::clamp((y - y_) * kPerM, 0.0F, static_cast<float>(rows_) - 1.001F);
  const int i = static_cast<int>(column), j = static_cast<int>(row);
  const float u = column - static_cast<float>(i), v = row - static_cast<float>(j);
  const float* low = &values_[grid_index(i, j, columns_)];
  const float* high = low + columns_;
  return mix(mix(low[0], low[1], u), mix(high[0], high[1], u), v);
}

}  // namespace vpdr::simulation
