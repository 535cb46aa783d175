#pragma once
// The ray of every pixel of a camera, made once, and cones around square tiles of pixels, by which
// a small thing is looked for only where it can be seen. Camera axes. Thread-safe once made.
#include <Eigen/Core>
#include <vector>

#include "simulation/camera.hpp"
#include "simulation/render/solid.hpp"

namespace vpdr::simulation {

class RayTable {
 public:
  static constexpr int kTile = 16;  ///< pixels, edge of a tile

  explicit RayTable(const Camera& camera);

  /// Unit rays of a row: one more than the image is wide. There is one more row than the image has.
  [[nodiscard]] const Eigen::Vector3f* row(int row) const {
    return &rays_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_ + 1)];
  }
  [[nodiscard]] int tile_columns() const { return tile_columns_; }
  [[nodiscard]] int tiles() const { return static_cast<int>(cones_.size()); }
  /// True where some pixel of the tile may see into the ball (camera axes).
  [[nodiscard]] bool may_see(int tile, const Ball& ball) const;

 private:
  struct Cone {
    Eigen::Vector3f axis;
    float cosine, sine;  ///< of the angle from its axis
  };

  [[nodiscard]] Cone cone_of(int first_column, int first_row, int height) const;

  int width_, tile_columns_;
  std::vector<Eigen::Vector3f> rays_;
  std::vector<Cone> cones_;
};

}  // namespace vpdr::simulation
