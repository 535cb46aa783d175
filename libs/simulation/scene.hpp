#pragma once
// What the corridors of a floor plan look like: doors, posters, notice boards, lockers, skirting
// and hand rail on the walls, tiles on the floor, a tiled ceiling with lamps, and the light they
// give. Shades are reflectances, 0 black to 1 white. All from one seed. Thread-safe once made.
#include <array>
#include <cstdint>
#include <vector>

#include "simulation/box_filter.hpp"
#include "simulation/floor_plan.hpp"

namespace vpdr::simulation {

/// A rectangle of one shade on a wall: `along` from the wall's left end, `up` from the floor.
struct Patch {
  Interval along;
  Interval up;
  float shade = 0.0F;
};

/// Something on a wall: patches, each painted over the ones before. `along` holds them all.
struct WallObject {
  Interval along;
  std::vector<Patch> patches;
};

/// The look of one wall. Objects are in order of `along` and do not overlap.
struct WallFace {
  std::array<Patch, 4> bands;  ///< over the whole length: dado, hand rail, skirting, top
  std::vector<WallObject> objects;
  std::vector<int> first_object;  ///< that reaches into each half metre or beyond it
  float paint = 0.0F;
  float facing = 1.0F;       ///< how much of the light walls of this direction get
  float texture_m = 0.0F;    ///< offset into the noise texture
  bool corner_left = false;  ///< the neighbouring wall stands in front of this one
  bool corner_right = false;
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
  Scene(const FloorPlan& plan, std::uint64_t seed);

  [[nodiscard]] const FloorPlan& plan() const { return plan_; }
  [[nodiscard]] const std::vector<WallFace>& faces() const { return faces_; }
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
