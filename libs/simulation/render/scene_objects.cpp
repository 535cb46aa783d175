// Doors, posters, boards, lockers and what else hangs on office corridor walls. Sizes in metres.
#include <algorithm>
#include <cmath>

#include "simulation/render/scene.hpp"

namespace vpdr::simulation {
namespace {

/// Paints patches relative to one corner of an object.
class Painter {
 public:
  Painter(float left, float width) : left_(left) { object_.along = {left, left + width}; }

  void paint(float from, float to, float bottom, float top, float shade) {
    object_.patches.push_back({{left_ + from, left_ + to}, {bottom, top}, shade});
  }

  WallObject take() { return std::move(object_); }

 private:
  float left_;
  WallObject object_;
};

float between(Random& random, double low, double high) {
  return static_cast<float>(random.uniform(low, high));
}

void paint_leaf(Painter& p, float from, float to, bool handle_right, bool pane, float shade,
                Random& random) {
  p.paint(from, to, 0.01F, 2.05F, shade);
  p.paint(from, to, 0.01F, 0.22F, shade * 0.72F);  // kick plate
  if (pane) {
    const float middle = handle_right ? mix(from, to, 0.72F) : mix(from, to, 0.28F);
    p.paint(middle - 0.09F, middle + 0.09F, 1.10F, 1.82F, shade * 0.5F);
    p.paint(middle - 0.07F, middle + 0.07F, 1.12F, 1.80F, between(random, 0.15, 0.85));
  }
  const float lock = handle_right ? to - 0.12F : from + 0.12F;
  p.paint(lock - 0.035F, lock + 0.035F, 0.93F, 1.13F, 0.80F);
  const float grip = handle_right ? lock - 0.12F : lock;
  p.paint(grip, grip + 0.12F, 1.03F, 1.06F, 0.30F);
}

WallObject door(float left, Random& random) {
  const float leaf = between(random, 0.85, 1.0);
  constexpr float kFrame = 0.08F, kPlate = 0.42F;
  const float frame_shade = random.chance(0.5) ? 0.25F : 0.88F;
  constexpr std::array<float, 5> kLeafShades = {0.30F, 0.42F, 0.52F, 0.38F, 0.60F};
  Painter p(left, leaf + 2.0F * kFrame + kPlate);
  p.paint(0.0F, leaf + 2.0F * kFrame, 0.0F, 2.05F + kFrame, frame_shade);
  p.paint(kFrame - 0.012F, kFrame + leaf + 0.012F, 0.0F, 2.062F, 0.10F);  // the gap around it
  paint_leaf(p, kFrame, kFrame + leaf, random.chance(0.5), random.chance(0.35),
             kLeafShades[random.index(kLeafShades.size())], random);
  // The plate with name and number, and the light switch below it.
  const float plate = leaf + 2.0F * kFrame + 0.12F;
  p.paint(plate, plate + 0.24F, 1.45F, 1.62F, random.chance(0.5) ? 0.22F : 0.92F);
  p.paint(plate + 0.03F, plate + between(random, 0.10, 0.21), 1.55F, 1.585F, 0.55F);
  p.paint(plate + 0.03F, plate + between(random, 0.10, 0.21), 1.485F, 1.51F, 0.55F);
  if (random.chance(0.5)) p.paint(plate, plate + 0.09F, 1.05F, 1.14F, 0.97F);
  return p.take();
}

WallObject double_door(float left, Random& random) {
  constexpr float kLeaf = 0.85F, kFrame = 0.09F;
  const float shade = between(random, 0.3, 0.6);
  Painter p(left, 2.0F * (kLeaf + kFrame));
  p.paint(0.0F, 2.0F * (kLeaf + kFrame), 0.0F, 2.05F + kFrame, 0.22F);
  paint_leaf(p, kFrame, kFrame + kLeaf, true, true, shade, random);
  paint_leaf(p, kFrame + kLeaf + 0.015F, kFrame + 2.0F * kLeaf, false, true, shade, random);
  p.paint(0.55F, 1.35F, 2.25F, 2.45F, 0.30F);  // the way out
  p.paint(0.60F, 0.95F, 2.29F, 2.41F, 0.95F);
  p.paint(1.05F, 1.30F, 2.32F, 2.38F, 0.95F);
  return p.take();
}

/// A sheet: margin, heading, lines of print, a picture or two.
void paint_sheet(Painter& p, float from, float bottom, float width, float height, Random& random) {
  const float paper = between(random, 0.75, 1.0);
  const float ink = between(random, 0.08, 0.4);
  p.paint(from, from + width, bottom, bottom + height, paper);
  const float head = height * between(random, 0.12, 0.25);
  if (random.chance(0.6)) {
    p.paint(from, from + width, bottom + height - head, bottom + height,
            between(random, 0.15, 0.6));
  }
  const float picture = height * between(random, 0.2, 0.45);
  const float picture_bottom = bottom + height * between(random, 0.08, 0.3);
  const float split = width * between(random, 0.35, 0.65);
  p.paint(from + 0.06F * width, from + split, picture_bottom, picture_bottom + picture,
          between(random, 0.1, 0.7));
  p.paint(from + 0.12F * width, from + 0.7F * split, picture_bottom + 0.25F * picture,
          picture_bottom + 0.7F * picture, between(random, 0.2, 0.95));
  const int lines = 3 + static_cast<int>(random.index(4));
  const float pitch = (height - head) / (static_cast<float>(lines) + 1.0F);
  for (int i = 0; i < lines; ++i) {
    const float y = bottom + pitch * (static_cast<float>(i) + 0.6F);
    p.paint(from + split + 0.05F * width, from + width * between(random, 0.78, 0.95), y,
            y + 0.28F * pitch, ink);
  }
}

WallObject poster(float left, Random& random) {
  const float width = between(random, 0.5, 0.9), height = between(random, 0.65, 1.15);
  const float bottom = 1.55F - 0.5F * height + between(random, -0.08, 0.12);
  Painter p(left, width + 0.06F);
  if (random.chance(0.6)) {
    p.paint(0.0F, width + 0.06F, bottom - 0.03F, bottom + height + 0.03F,
            between(random, 0.05, 0.35));
  }
  paint_sheet(p, 0.03F, bottom, width, height, random);
  return p.take();
}

WallObject notice_board(float left, Random& random) {
  const float width = between(random, 1.2, 1.9);
  Painter p(left, width);
  p.paint(0.0F, width, 1.05F, 2.0F, 0.20F);
  p.paint(0.04F, width - 0.04F, 1.09F, 1.96F, between(random, 0.35, 0.55));
  float x = 0.09F;
  while (x + 0.32F < width) {
    const float sheet = between(random, 0.18, 0.24);
    const float bottom = between(random, 1.12, 1.25);
    paint_sheet(p, x, bottom, sheet, 0.30F, random);
    if (random.chance(0.7)) {
      paint_sheet(p, x + between(random, -0.02, 0.04), bottom + 0.36F, sheet, 0.28F, random);
    }
    x += sheet + between(random, 0.05, 0.12);
  }
  return p.take();
}

WallObject lockers(float left, Random& random) {
  const int count = 2 + static_cast<int>(random.index(3));
  constexpr float kWidth = 0.40F, kHeight = 1.80F;
  const float shade = between(random, 0.35, 0.7);
  const float width = kWidth * static_cast<float>(count);
  Painter p(left, width);
  p.paint(0.0F, width, 0.0F, kHeight, 0.15F);
  for (int i = 0; i < count; ++i) {
    const float x = kWidth * static_cast<float>(i);
    p.paint(x + 0.01F, x + kWidth - 0.01F, 0.08F, kHeight - 0.015F, shade);
    for (const float slot : {1.50F, 1.56F, 1.62F}) {
      p.paint(x + 0.10F, x + kWidth - 0.10F, slot, slot + 0.02F, 0.12F);
    }
    p.paint(x + 0.32F, x + 0.35F, 0.95F, 1.07F, 0.85F);
  }
  return p.take();
}

WallObject extinguisher(float left, Random& random) {
  Painter p(left, 0.30F);
  p.paint(0.0F, 0.30F, 1.75F, 2.05F, 0.28F);  // the sign above
  p.paint(0.06F, 0.24F, 1.81F, 1.99F, 0.95F);
  p.paint(0.10F, 0.20F, 1.84F, 1.95F, 0.28F);
  const float shade = between(random, 0.2, 0.32);
  p.paint(0.07F, 0.23F, 0.55F, 1.05F, shade);
  p.paint(0.10F, 0.13F, 0.57F, 1.00F, shade + 0.25F);  // highlight on the cylinder
  p.paint(0.11F, 0.19F, 1.05F, 1.16F, 0.08F);
  p.paint(0.08F, 0.22F, 0.75F, 0.87F, 0.9F);
  return p.take();
}

WallObject draw_object(float left, Random& random) {
  const double draw = random.uniform();
  if (draw < 0.48) return door(left, random);
  if (draw < 0.70) return poster(left, random);
  if (draw < 0.82) return notice_board(left, random);
  if (draw < 0.92) return lockers(left, random);
  return extinguisher(left, random);
}

}  // namespace

std::vector<WallObject> draw_wall_objects(float length_m, bool end_wall, Random& random) {
  std::vector<WallObject> objects;
  constexpr float kDoubleDoorM = 1.88F;
  if (end_wall && length_m > kDoubleDoorM + 0.1F) {
    objects.push_back(double_door(0.5F * (length_m - kDoubleDoorM), random));
    return objects;
  }
  float left = kObjectGapM + between(random, 0.0, 0.8);
  while (left < length_m) {
    WallObject object = draw_object(left, random);
    const float right = object.along.high;
    if (right + kObjectGapM <= length_m) objects.push_back(std::move(object));
    left = right + kObjectGapM + between(random, 0.0, 1.6);
  }
  return objects;
}

}  // namespace vpdr::simulation
