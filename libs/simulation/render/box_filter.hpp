#pragma once
// Exact averages of simple patterns over a pixel's footprint, so that what is far away neither
// shimmers nor loses its edges: rectangles, lines on a grid, tiles, and a noise texture with its
// coarser copies. Lengths in metres, single precision. Thread-safe once made.
#include <algorithm>
#include <vector>

#include "simulation/random.hpp"

namespace vpdr::simulation {

/// An interval of a surface that an object covers.
struct Interval {
  float low = 0.0F;
  float high = 0.0F;
};

/// An interval of a surface that one pixel sees.
struct Footprint {
  Footprint(float centre, float width)
      : low(centre - 0.5F * width), high(centre + 0.5F * width), per_width(1.0F / width) {}

  [[nodiscard]] float width() const { return high - low; }

  float low;
  float high;
  float per_width;
};

/// Share of the footprint that the object covers.
inline float coverage(const Footprint& footprint, const Interval& object) {
  const float common = std::min(footprint.high, object.high) - std::max(footprint.low, object.low);
  return common <= 0.0F ? 0.0F : common * footprint.per_width;
}

/// Largest whole number not above x; without the library call that plain x86-64 makes of floor().
inline int whole_below(float x) {
  const int truncated = static_cast<int>(x);
  return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

/// Share of the footprint on lines of `line` width, one every `period`, the first centred at
/// `origin`.
inline float line_coverage(const Footprint& footprint, float origin, float period, float line) {
  const float per_period = 1.0F / period;
  const auto covered_up_to = [&](float x) {
    const float shifted = x - origin + 0.5F * line;
    const auto whole = static_cast<float>(whole_below(shifted * per_period));
    return whole * line + std::min(shifted - whole * period, line);
  };
  return (covered_up_to(footprint.high) - covered_up_to(footprint.low)) * footprint.per_width;
}

inline float mix(float from, float to, float share) { return from + share * (to - from); }

/// Square tiles, each with a value; averages over rectangles by a summed-area table (Crow 1984).
class TileMap {
 public:
  /// Lower left corner of tile (0, 0), edge length, values row by row.
  TileMap(float x, float y, float tile, int columns, std::vector<float> values);
  [[nodiscard]] float average(const Footprint& x, const Footprint& y) const;

 private:
  [[nodiscard]] float integral(float column, float row) const;

  float x_, y_, tile_;
  int columns_, rows_;
  std::vector<float> sums_;  ///< over all tiles to the lower left of each corner
};

/// Value noise of zero mean and about unit amplitude with features from 1 cm to 1 m, repeating
/// every 4.1 m; its finer parts fade as the footprint grows.
class NoiseTexture {
 public:
  explicit NoiseTexture(Random random);
  /// Bilinear sample where a pixel covers `footprint` metres.
  [[nodiscard]] float at(float x, float y, float footprint) const;

 private:
  static constexpr int kSize = 512;
  static constexpr float kTexel = 0.008F;
  std::vector<std::vector<float>> levels_;  ///< each half the resolution of the one before
};

}  // namespace vpdr::simulation
