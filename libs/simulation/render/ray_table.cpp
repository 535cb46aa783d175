#include "simulation/render/ray_table.hpp"

#include <algorithm>
#include <cmath>

namespace vpdr::simulation {

using Eigen::Vector3f;

RayTable::RayTable(const Camera& camera)
    : width_(camera.width), tile_columns_((camera.width + kTile - 1) / kTile) {
  rays_.reserve(static_cast<std::size_t>(camera.width + 1) *
                static_cast<std::size_t>(camera.height + 1));
  for (int row = 0; row <= camera.height; ++row) {
    for (int column = 0; column <= camera.width; ++column) {
      rays_.push_back(camera.ray({column, row}).cast<float>());
    }
  }
  for (int first_row = 0; first_row < camera.height; first_row += kTile) {
    for (int first = 0; first < camera.width; first += kTile) {
      cones_.push_back(cone_of(first, first_row, camera.height));
    }
  }
}

RayTable::Cone RayTable::cone_of(int first_column, int first_row, int height) const {
  const int last_row = std::min(first_row + kTile, height);
  const int last_column = std::min(first_column + kTile, width_);
  Cone cone{row((first_row + last_row) / 2)[(first_column + last_column) / 2], 1.0F, 0.0F};
  for (int j = first_row; j <= last_row; ++j) {
    for (int i = first_column; i <= last_column; ++i) {
      cone.cosine = std::min(cone.cosine, cone.axis.dot(row(j)[i]));
    }
  }
  cone.sine = std::sqrt(std::max(0.0F, 1.0F - cone.cosine * cone.cosine));
  return cone;
}

bool RayTable::may_see(int tile, const Ball& ball) const {
  const float distance = ball.middle_m.norm();
  if (distance <= ball.radius_m) return true;
  const float sine = ball.radius_m / distance, cosine = std::sqrt(1.0F - sine * sine);
  const Cone& cone = cones_[static_cast<std::size_t>(tile)];
  return cone.axis.dot(ball.middle_m) >= distance * (cone.cosine * cosine - cone.sine * sine);
}

}  // namespace vpdr::simulation
