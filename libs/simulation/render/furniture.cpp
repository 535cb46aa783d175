#include "simulation/render/furniture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

constexpr double kApartM = 0.5;  // of the way from furniture

float between(Random& random, double low, double high) {
  return static_cast<float>(random.uniform(low, high));
}

/// Boards with books of all sizes and shades between them.
std::vector<Patch> books(float width, float height, Random& random) {
  std::vector<Patch> patches{{{0.02F, width - 0.02F}, {0.02F, height - 0.02F}, 0.12F}};
  const int boards = std::max(1, static_cast<int>(height / 0.36F));
  const float pitch = height / static_cast<float>(boards);
  for (int board = 0; board < boards; ++board) {
    const float bottom = pitch * static_cast<float>(board) + 0.03F;
    patches.push_back({{0.0F, width}, {bottom - 0.03F, bottom}, 0.7F});
    float left = 0.03F;
    while (left < width - 0.10F) {
      const float thick = between(random, 0.03, 0.09);
      if (random.chance(0.9)) {
        patches.push_back({{left, left + thick},
                           {bottom, bottom + pitch * between(random, 0.55, 0.85)},
                           between(random, 0.1, 0.95)});
      }
      left += thick + (random.chance(0.1) ? 0.12F : 0.004F);
    }
  }
  return patches;
}

/// Drawers or doors with handles.
std::vector<Patch> drawers(float width, float height, float shade, Random& random) {
  std::vector<Patch> patches;
  const int columns = std::max(1, static_cast<int>(width / 0.5F));
  const int rows = 1 + static_cast<int>(random.index(4));
  const float w = width / static_cast<float>(columns), h = height / static_cast<float>(rows);
  for (int i = 0; i < columns * rows; ++i) {
    const int column = i % columns, row = i / columns;
    const float x = w * static_cast<float>(column), y = h * static_cast<float>(row);
    patches.push_back({{x + 0.008F, x + w - 0.008F},
                       {y + 0.008F, y + h - 0.008F},
                       shade * between(random, 0.75, 0.95)});
    patches.push_back({{x + 0.4F * w, x + 0.6F * w}, {y + 0.72F * h, y + 0.72F * h + 0.02F}, 0.1F});
  }
  return patches;
}

/// Tape, a label with lines of print.
std::vector<Patch> carton(float width, float height, Random& random) {
  const float x = width * between(random, 0.1, 0.4), y = height * between(random, 0.2, 0.5);
  return {{{0.46F * width, 0.54F * width}, {0.0F, height}, 0.75F},
          {{x, x + 0.4F * width}, {y, y + 0.35F * height}, 0.95F},
          {{x + 0.03F, x + 0.3F * width}, {y + 0.22F * height, y + 0.27F * height}, 0.1F},
          {{x + 0.03F, x + 0.22F * width}, {y + 0.1F * height, y + 0.15F * height}, 0.2F}};
}

Solid draw_piece(Random& random) {
  Solid piece;
  const double draw = random.uniform();
  piece.shade = between(random, 0.25, 0.8);
  if (draw < 0.4) {
    piece.size_m = {between(random, 0.28, 0.4), between(random, 0.8, 1.6),
                    between(random, 0.9, 2.1)};
    piece.faces[0] = books(piece.size_m.y(), piece.size_m.z(), random);
  } else if (draw < 0.75) {
    piece.size_m = {between(random, 0.4, 0.65), between(random, 0.5, 1.5),
                    between(random, 0.65, 1.4)};
    piece.faces[0] = drawers(piece.size_m.y(), piece.size_m.z(), piece.shade, random);
    piece.faces[1] = drawers(piece.size_m.x(), piece.size_m.z(), piece.shade, random);
  } else {
    piece.size_m = {between(random, 0.3, 0.6), between(random, 0.4, 0.7),
                    between(random, 0.3, 0.6)};
    piece.shade = between(random, 0.4, 0.6);
    piece.faces[0] = carton(piece.size_m.y(), piece.size_m.z(), random);
    piece.faces[1] = carton(piece.size_m.x(), piece.size_m.z(), random);
  }
  return piece;
}

/// What lies on a piece: a smaller box, as a carton or a screen.
Solid draw_burden(const Solid& below, Random& random) {
  Solid burden;
  burden.size_m = {0.5F * below.size_m.x(), between(random, 0.25, 0.45),
                   between(random, 0.15, 0.4)};
  burden.shade = between(random, 0.15, 0.9);
  burden.faces[0] = carton(burden.size_m.y(), burden.size_m.z(), random);
  burden.yaw_rad = below.yaw_rad + between(random, -0.3, 0.3);
  burden.foot_m = below.foot_m + Vector3f(0.0F, 0.0F, below.size_m.z());
  return burden;
}

}  // namespace

std::vector<Solid> draw_furniture(const Rectangle& room, const std::vector<Vector2d>& way,
                                  double share, Random& random) {
  std::vector<Solid> furniture;
  const Vector2d size = room.max_m - room.min_m;
  for (int side = 0; side < 4; ++side) {
    const int axis = side % 2;  // along which the wall runs
    const bool at_high_end = side >= 2;
    double along = random.uniform(0.2, 0.8);
    while (along < size[axis] - 0.8) {
      Solid piece = draw_piece(random);
      const double length = piece.size_m.y(), depth = piece.size_m.x();
      Vector2d middle;
      middle[axis] = room.min_m[axis] + along + 0.5 * length;
      middle[1 - axis] = at_high_end ? room.max_m[1 - axis] - 0.5 * depth - 0.01
                                     : room.min_m[1 - axis] + 0.5 * depth + 0.01;
      piece.foot_m = {static_cast<float>(middle.x()), static_cast<float>(middle.y()),
                      static_cast<float>(room.floor_m)};
      piece.yaw_rad = axis == 0 ? static_cast<float>(0.5 * std::numbers::pi) : 0.0F;
      const double reach = 0.5 * std::hypot(length, depth) + kApartM;
      const bool is_free = std::none_of(way.begin(), way.end(), [&](const Vector2d& p) {
        return (p - middle).squaredNorm() < reach * reach;
      });
      if (is_free && along + length < size[axis] - 0.2 && random.chance(share)) {
        if (piece.size_m.z() < 1.5F && random.chance(0.6)) {
          furniture.push_back(draw_burden(piece, random));
        }
        furniture.push_back(std::move(piece));
      }
      along += length + random.uniform(0.05, 0.7);
    }
  }
  return furniture;
}

}  // namespace vpdr::simulation
