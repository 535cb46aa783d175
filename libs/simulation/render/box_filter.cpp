#include "simulation/render/box_filter.hpp"

#include <cstddef>
#include <utility>

#include "simulation/grid_index.hpp"

namespace vpdr::simulation {

TileMap::TileMap(float x, float y, float tile, int columns, std::vector<float> values)
    : x_(x),
      y_(y),
      tile_(tile),
      columns_(columns),
      rows_(static_cast<int>(values.size()) / columns),
      sums_(grid_index(0, rows_ + 1, columns_ + 1), 0.0F) {
  for (int row = 0; row < rows_; ++row) {
    float line = 0.0F;
    for (int column = 0; column < columns_; ++column) {
      line += values[grid_index(column, row, columns_)];
      const auto corner = grid_index(column + 1, row + 1, columns_ + 1);
      sums_[corner] = sums_[corner - static_cast<std::size_t>(columns_ + 1)] + line;
    }
  }
}

float TileMap::integral(float column, float row) const {
  const float x = std::clamp(column, 0.0F, static_cast<float>(columns_));
  const float y = std::clamp(row, 0.0F, static_cast<float>(rows_));
  const int i = std::min(static_cast<int>(x), columns_ - 1);
  const int j = std::min(static_cast<int>(y), rows_ - 1);
  const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
  const float* low = &sums_[grid_index(i, j, columns_ + 1)];
  const float* high = low + columns_ + 1;
  // Exact: inside a tile the integral is bilinear.
  return mix(mix(low[0], low[1], u), mix(high[0], high[1], u), v);
}

float TileMap::average(const Footprint& x, const Footprint& y) const {
  const float scale = 1.0F / tile_;
  const float left = (x.low - x_) * scale, right = (x.high - x_) * scale;
  const float low = (y.low - y_) * scale, high = (y.high - y_) * scale;
  const float sum =
      integral(right, high) - integral(left, high) - integral(right, low) + integral(left, low);
  return sum * x.per_width * y.per_width * tile_ * tile_;
}

namespace {

/// Random values on a coarse grid, interpolated smoothly to `size` by `size`, wrapping around.
void add_octave(std::vector<float>& texture, int size, int cells, float amplitude, Random& random) {
  std::vector<float> grid(grid_index(0, cells, cells));
  for (float& value : grid) value = static_cast<float>(random.uniform(-1.0, 1.0));
  const auto value = [&](int x, int y) { return grid[grid_index(x % cells, y % cells, cells)]; };
  for (int j = 0; j < size; ++j) {
    const float y = static_cast<float>(j * cells) / static_cast<float>(size);
    const int row = static_cast<int>(y);
    const float v = y - static_cast<float>(row), sv = v * v * (3.0F - 2.0F * v);
    for (int i = 0; i < size; ++i) {
      const float x = static_cast<float>(i * cells) / static_cast<float>(size);
      const int column = static_cast<int>(x);
      const float u = x - static_cast<float>(column), su = u * u * (3.0F - 2.0F * u);
      texture[grid_index(i, j, size)] +=
          amplitude * mix(mix(value(column, row), value(column + 1, row), su),
                          mix(value(column, row + 1), value(column + 1, row + 1), su), sv);
    }
  }
}

std::vector<float> halved(const std::vector<float>& texture, int size) {
  const int half = size / 2;
  std::vector<float> result(grid_index(0, half, half));
  for (int j = 0; j < half; ++j) {
    for (int i = 0; i < half; ++i) {
      const auto corner = grid_index(2 * i, 2 * j, size);
      const auto below = corner + static_cast<std::size_t>(size);
      result[grid_index(i, j, half)] =
          0.25F * (texture[corner] + texture[corner + 1] + texture[below] + texture[below + 1]);
    }
  }
  return result;
}

}  // namespace

NoiseTexture::NoiseTexture(Random random) {
  std::vector<float> finest(grid_index(0, kSize, kSize), 0.0F);
  const std::pair<int, float> octaves[] = {
      {4, 0.8F}, {13, 0.7F}, {47, 0.6F}, {157, 0.7F}, {512, 0.6F}};
  for (const auto& [cells, amplitude] : octaves) {
    add_octave(finest, kSize, cells, amplitude, random);
  }
  levels_.push_back(std::move(finest));
  for (int size = kSize; size > 4; size /= 2) levels_.push_back(halved(levels_.back(), size));
}

float NoiseTexture::at(float x, float y, float footprint) const {
  int level = 0;
  float texel = kTexel;
  const int last = static_cast<int>(levels_.size()) - 1;
  while (level < last && footprint > 1.4F * texel) {
    ++level;
    texel *= 2.0F;
  }
  const int size = kSize >> level;
  const float column = x / texel, row = y / texel;
  const int i = whole_below(column), j = whole_below(row);
  const float u = column - static_cast<float>(i), v = row - static_cast<float>(j);
  const int mask = size - 1;
  const float* low = &levels_[static_cast<std::size_t>(level)][grid_index(0, j & mask, size)];
  const float* high =
      &levels_[static_cast<std::size_t>(level)][grid_index(0, (j + 1) & mask, size)];
  return mix(mix(low[i & mask], low[(i + 1) & mask], u),
             mix(high[i & mask], high[(i + 1) & mask], u), v);
}

}  // namespace vpdr::simulation
