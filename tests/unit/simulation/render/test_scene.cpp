#include <gtest/gtest.h>

#include "simulation/building.hpp"
#include "simulation/render/scene.hpp"

namespace vpdr::simulation {
namespace {

FloorPlan drawn_plan(std::uint64_t seed) {
  Random random(seed, "scene test");
  return FloorPlan(draw_building({}, random).corridors);
}

TEST(Scene, ObjectsKeepApartAndStayOnTheirWall) {
  const Scene scene(drawn_plan(1), 1);
  std::size_t objects = 0;
  for (std::size_t i = 0; i < scene.faces().size(); ++i) {
    const auto length = static_cast<float>(scene.plan().walls()[i].length_m());
    float end = 0.0F;
    for (const WallObject& object : scene.faces()[i].rows[0].objects) {
      ++objects;
      EXPECT_GE(object.along.low, end + kObjectGapM - 1e-4F);
      EXPECT_LE(object.along.high, length - kObjectGapM + 1e-4F);
      end = object.along.high;
      for (const Patch& patch : object.patches) {
        EXPECT_GE(patch.along.low, object.along.low - 1e-4F);
        EXPECT_LE(patch.along.high, object.along.high + 1e-4F);
        EXPECT_LT(patch.along.low, patch.along.high);
        EXPECT_LT(patch.up.low, patch.up.high);
        EXPECT_GE(patch.shade, 0.0F);
        EXPECT_LE(patch.shade, 1.0F);
      }
    }
  }
  EXPECT_GT(objects, 100u);
}

TEST(Scene, EveryHalfMetreKnowsItsFirstObject) {
  const Scene scene(drawn_plan(2), 2);
  for (const WallFace& face : scene.faces()) {
    const WallRow& row = face.rows[0];
    for (std::size_t bucket = 0; bucket < row.first_object.size(); ++bucket) {
      const float from = 0.5F * static_cast<float>(bucket);
      for (int i = 0; i < static_cast<int>(row.objects.size()); ++i) {
        const bool passed = row.objects[static_cast<std::size_t>(i)].along.high < from;
        EXPECT_EQ(passed, i < row.first_object[bucket]);
      }
    }
  }
}

TEST(Scene, EveryCorridorIsLit) {
  const Scene scene(drawn_plan(3), 3);
  for (const Rectangle& corridor : scene.plan().corridors()) {
    const Eigen::Vector2f middle = (0.5 * (corridor.min_m + corridor.max_m)).cast<float>();
    EXPECT_GT(scene.light().at(middle.x(), middle.y()), 0.75F);
  }
}

TEST(Scene, TheSeedDecidesTheLook) {
  const Scene a(drawn_plan(1), 1), b(drawn_plan(1), 1), c(drawn_plan(1), 2);
  ASSERT_FALSE(a.faces()[0].rows[0].objects.empty());
  EXPECT_EQ(a.faces()[0].paint, b.faces()[0].paint);
  EXPECT_NE(a.faces()[0].paint, c.faces()[0].paint);
}

}  // namespace
}  // namespace vpdr::simulation
