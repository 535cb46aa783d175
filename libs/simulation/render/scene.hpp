#pragma once
// What the inside of a building looks like: doors, posters, notice boards, lockers, skirting and
// hand rail on the walls, tiles on the floor, a tiled ceiling with lamps, the light they give, and
// furniture. Shades are reflectances, 0 black to 1 white. All from one seed. Thread-safe once made.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "simulation/floor_plan.hpp"
#include "simulation/render/box_filter.hpp"
#include "simulation/render/solid.hpp"

namespace vpdr::simulation {

/// Something on a wall: patches, each painted over the ones before. `along` holds them all.
struct WallObject {
  Interval along;
  std::vector<Patch> patches;
};

/// Objects between two heights, in order of `along`, none overlapping another.
struct WallRow {
  std::vector<WallObject> objects;
  std::vector<int> first_object;  ///< that reaches into each half metre or beyond it
};

/// The look of one wall. High walls have a row of objects every kRowM.
struct WallFace {
  static constexpr float kRowM = 2.8F;

  std::array<Patch, 4> bands;  ///< over the whole length: dado, hand rail, skirting, top
  std::vector<WallRow> rows;
  float length_m = 0.0F;
  float paint = 0.0F;
  float facing = 1.0F;       ///< how much of the light walls of this direction get
  float texture_m = 0.0F;    ///< offset into the noise texture
  bool corner_left = false;  ///< the neighbouring wall stands in front of this one
  bool corner_right = false;

  [[nodiscard]] const WallRow& row_at(float up) const {
    const int last = static_cast<int>(rows.size()) - 1;
    return rows[static_cast<std::size_t>(std::clamp(static_cast<int>(up / kRowM), 0, last))];
  }
};

/// Brightness over the floor plan on a regular grid.
class LightMap {
 public:
  LightMap(const FloorPlan& plan, const std::vector<Eigen::Vector2d>& lamps_m);
  [[nodiscard]] float at(float x, float y) const;

 private:
  float x_, y_;
  int columns_, rows_;
  std::vector<float> values_;
};

class Scene {
 public:
  Scene(const FloorPlan& plan, std::uint64_t seed, std::vector<Solid> furniture = {});

  [[nodiscard]] const FloorPlan& plan() const { return plan_; }
  [[nodiscard]] const std::vector<WallFace>& faces() const { return faces_; }
  [[nodiscard]] const std::vector<Solid>& furniture() const { return furniture_; }
  [[nodiscard]] const TileMap& floor_tiles() const { return floor_tiles_; }
  [[nodiscard]] const TileMap& lamps() const { return lamps_; }
  [[nodiscard]] const LightMap& light() const { return light_; }
  [[nodiscard]] const NoiseTexture& noise() const { return noise_; }

  /// Where the edges between tiles lie, on both axes: this plus whole tiles.
  static constexpr float kTileOffsetM = 0.3F;

 private:
  FloorPlan plan_;
  std::vector<Eigen::Vector2d> lamp_places_m_;
  std::vector<WallFace> faces_;
  std::vector<Solid> furniture_;
  TileMap floor_tiles_;
  TileMap lamps_;  ///< 1 where the ceiling tile is a lamp
  LightMap light_;
  NoiseTexture noise_;
};

/// Door frames stand off the wall's ends and each other by this much at least, metres.
inline constexpr float kObjectGapM = 0.35F;

/// Draws what hangs on a wall of the given length.
std::vector<WallObject> draw_wall_objects(float length_m, bool end_wall, Random& random);

}  // namespace vpdr::simulation
