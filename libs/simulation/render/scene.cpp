#include "simulation/render/scene.hpp"

#include <cmath>
#include <utility>

#include "simulation/building.hpp"
#include "simulation/grid_index.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;

/// Index of the tile that holds a coordinate.
int tile_index(double coordinate) {
  return static_cast<int>(std::floor((coordinate - Scene::kTileOffsetM) / kTileM));
}

double tile_centre(int index) { return Scene::kTileOffsetM + (index + 0.5) * kTileM; }

/// A row of lamps along the middle of each corridor; a hall gets several rows.
std::vector<Vector2d> place_lamps(const FloorPlan& plan) {
  std::vector<Vector2d> lamps;
  for (const Rectangle& corridor : plan.corridors()) {
    const Vector2d size = corridor.max_m - corridor.min_m;
    if (size.minCoeff() < 1.0) continue;  // the tread of a step
    const Vector2d middle = 0.5 * (corridor.min_m + corridor.max_m);
    const int axis = size.x() >= size.y() ? 0 : 1;  // along the corridor
    const int across = 1 - axis;
    const int rows = std::max(1, static_cast<int>(size[across] / 3.6));
    for (int row = 0; row < rows; ++row) {
      const double side = middle[across] + (row - 0.5 * (rows - 1)) * 3.6;
      const int first = tile_index(corridor.min_m[axis] + 0.8);
      const int last = tile_index(corridor.max_m[axis] - 0.8);
      for (int tile = first; tile <= last; ++tile) {
        if (((tile % 4) + 4) % 4 != 1) continue;
        Vector2d lamp;
        lamp[axis] = tile_centre(tile);
        lamp[across] = tile_centre(tile_index(side));
        // Where corridors cross, one of them lights both.
        const auto close = [&](const Vector2d& other) { return (other - lamp).norm() < 1.3; };
        if (std::none_of(lamps.begin(), lamps.end(), close)) lamps.push_back(lamp);
      }
    }
  }
  return lamps;
}

struct TileGrid {
  explicit TileGrid(const FloorPlan& plan) {
    const Rectangle bounds = plan.bounds();
    first_column = tile_index(bounds.min_m.x());
    first_row = tile_index(bounds.min_m.y());
    columns = tile_index(bounds.max_m.x()) - first_column + 1;
    rows = tile_index(bounds.max_m.y()) - first_row + 1;
  }
  [[nodiscard]] TileMap map(std::vector<float> values) const {
    return {static_cast<float>(tile_centre(first_column) - 0.5 * kTileM),
            static_cast<float>(tile_centre(first_row) - 0.5 * kTileM), static_cast<float>(kTileM),
            columns, std::move(values)};
  }
  [[nodiscard]] std::vector<float> blank() const {
    return std::vector<float>(grid_index(0, rows, columns), 0.0F);
  }
  int first_column = 0, first_row = 0, columns = 0, rows = 0;
};

TileMap lamp_tiles(const FloorPlan& plan, const std::vector<Vector2d>& lamps) {
  const TileGrid grid(plan);
  std::vector<float> values = grid.blank();
  for (const Vector2d& lamp : lamps) {
    const int column = tile_index(lamp.x()) - grid.first_column;
    const int row = tile_index(lamp.y()) - grid.first_row;
    values[grid_index(column, row, grid.columns)] = 1.0F;
  }
  return grid.map(std::move(values));
}

/// Tiles of slightly different shade, some of a second colour.
TileMap shaded_tiles(const FloorPlan& plan, Random random) {
  const TileGrid grid(plan);
  std::vector<float> values = grid.blank();
  for (float& value : values) {
    value = static_cast<float>(random.normal(0.018)) - (random.chance(0.08) ? 0.13F : 0.0F);
  }
  return grid.map(std::move(values));
}

/// True where another wall begins at `corner` and stands in front of `wall`.
bool stands_in_front(const FloorPlan& plan, const Wall& wall, const Vector2d& corner,
                     const Vector2d& outward) {
  return !plan.contains(corner + 0.01 * wall.normal + 0.01 * outward);
}

/// For each half metre, the first object that reaches into it or beyond it.
std::vector<int> first_objects(const std::vector<WallObject>& objects, float length) {
  std::vector<int> first;
  const int buckets = static_cast<int>(length / 0.5F) + 2;
  int object = 0;
  for (int bucket = 0; bucket < buckets; ++bucket) {
    while (object < static_cast<int>(objects.size()) &&
           objects[static_cast<std::size_t>(object)].along.high <
               0.5F * static_cast<float>(bucket)) {
      ++object;
    }
    first.push_back(object);
  }
  return first;
}

WallRow draw_row(float length, float bottom, bool end_wall, Random& random) {
  WallRow row{draw_wall_objects(length, end_wall, random), {}};
  for (WallObject& object : row.objects) {
    for (Patch& patch : object.patches) {
      patch.up = {patch.up.low + bottom, patch.up.high + bottom};
    }
  }
  row.first_object = first_objects(row.objects, length);
  return row;
}

WallFace draw_face(const FloorPlan& plan, const Wall& wall, Random random) {
  WallFace face;
  const Vector2d along = (wall.end_m - wall.start_m).normalized();
  const auto length = static_cast<float>(wall.length_m());
  const auto height = static_cast<float>(wall.height_m);
  face.length_m = length;
  face.corner_left = stands_in_front(plan, wall, wall.start_m, -along);
  face.corner_right = stands_in_front(plan, wall, wall.end_m, along);
  face.facing = std::abs(wall.normal.x()) > 0.5 ? 0.90F : 1.0F;
  face.texture_m = static_cast<float>(random.uniform(0.0, 4.0));
  constexpr float kTreadM = 0.5F;  // the pieces of wall beside stairs are of one paint
  const bool beside_stairs = length < kTreadM;
  const auto drawn = [&](double low, double high) {
    const double shade = random.uniform(low, high);
    return static_cast<float>(beside_stairs ? 0.5 * (low + high) : shade);
  };
  face.paint = 0.80F + drawn(-0.05, 0.05);
  const Interval whole{-1.0F, length + 1.0F};
  const float dado = face.paint - drawn(0.08, 0.22);
  face.bands = {Patch{whole, {0.0F, 0.92F}, dado}, Patch{whole, {0.90F, 0.99F}, 0.30F},
                Patch{whole, {-0.1F, 0.11F}, 0.17F},
                Patch{whole, {height - 0.06F, height + 0.1F}, 0.55F}};
  const bool end_wall = face.corner_left && face.corner_right && length < 4.0F;
  face.rows.push_back(draw_row(length, 0.0F, end_wall, random));
  for (float bottom = WallFace::kRowM; bottom + 2.5F < height; bottom += WallFace::kRowM) {
    face.rows.push_back(draw_row(length, bottom, false, random));
  }
  return face;
}

std::vector<WallFace> draw_faces(const FloorPlan& plan, std::uint64_t seed) {
  std::vector<WallFace> faces;
  for (std::size_t i = 0; i < plan.walls().size(); ++i) {
    faces.push_back(draw_face(plan, plan.walls()[i], Random(mix_bits(seed) + i, "wall")));
  }
  return faces;
}

}  // namespace

Scene::Scene(const FloorPlan& plan, std::uint64_t seed, std::vector<Solid> furniture)
    : plan_(plan),
      lamp_places_m_(place_lamps(plan)),
      faces_(draw_faces(plan, seed)),
      furniture_(std::move(furniture)),
      floor_tiles_(shaded_tiles(plan, Random(seed, "floor"))),
      lamps_(lamp_tiles(plan, lamp_places_m_)),
      light_(plan, lamp_places_m_),
      noise_(Random(seed, "texture")) {}

}  // namespace vpdr::simulation
