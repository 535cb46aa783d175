#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "simulation/building.hpp"
#include "simulation/floor_plan.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;

FloorPlan bend() {  // an L: 10 m east, then 8 m north, 2 m wide
  return FloorPlan({{{-1.0, -1.0}, {11.0, 1.0}}, {{9.0, -1.0}, {11.0, 8.0}}});
}

TEST(FloorPlan, ABendHasSixWalls) {
  const FloorPlan plan = bend();
  ASSERT_EQ(plan.walls().size(), 6u);
  double length = 0.0;
  for (const Wall& wall : plan.walls()) length += wall.length_m();
  EXPECT_NEAR(length, 12.0 + 9.0 + 2.0 + 7.0 + 10.0 + 2.0, 1e-12);
}

TEST(FloorPlan, WallsRunFromLeftToRightAsSeenFromTheCorridor) {
  const FloorPlan plan = bend();
  for (const Wall& wall : plan.walls()) {
    const Vector2d along = (wall.end_m - wall.start_m).normalized();
    const Vector2d facing = -wall.normal;
    EXPECT_TRUE(along.isApprox(Vector2d(facing.y(), -facing.x())));  // facing turned right
    EXPECT_TRUE(plan.contains(0.5 * (wall.start_m + wall.end_m) + 0.01 * wall.normal));
  }
}

TEST(FloorPlan, SightEndsAtTheNearestWall) {
  const FloorPlan plan = bend();
  EXPECT_NEAR(plan.cast({0.0, 0.0}, {1.0, 0.0}).distance, 11.0, 1e-12);
  EXPECT_NEAR(plan.cast({0.0, 0.0}, {0.0, 2.0}).distance, 0.5, 1e-12);  // in direction lengths
  EXPECT_NEAR(plan.cast({10.0, 0.0}, {0.0, 1.0}).distance, 8.0, 1e-12);
  EXPECT_NEAR(plan.cast({10.0, 7.0}, {-1.0, -1.0}).distance, 1.0, 1e-12);
  EXPECT_EQ(plan.cast({5.0, 5.0}, {1.0, 0.0}).wall, -1);
}

TEST(FloorPlan, ClearanceIsSignedDistance) {
  const FloorPlan plan = bend();
  EXPECT_NEAR(plan.clearance_m({4.0, 0.3}), 0.7, 1e-12);
  EXPECT_NEAR(plan.clearance_m({4.0, 1.5}), -0.5, 1e-12);
  // The inner corner at (9, 1), from the middle of the bend.
  EXPECT_NEAR(plan.clearance_m({10.0, 0.0}), 1.0, 1e-12);
}

TEST(FloorPlan, RefusesNoCorridorAndNoWidth) {
  EXPECT_THROW(FloorPlan({}), ConfigurationFault);
  EXPECT_THROW(FloorPlan({{{0.0, 0.0}, {5.0, 0.0}}}), ConfigurationFault);
}

/// Property: walls of any building close, and nobody sees through them.
class DrawnPlan : public testing::TestWithParam<int> {
 protected:
  FloorPlan plan_ = [] {
    Random random(static_cast<std::uint64_t>(GetParam()), "plan test");
    return FloorPlan(draw_building({}, random).corridors);
  }();
};

TEST_P(DrawnPlan, EveryWallEndMeetsExactlyOneOtherWall) {
  std::map<std::pair<double, double>, int> starts, ends;
  for (const Wall& wall : plan_.walls()) {
    ++starts[{wall.start_m.x(), wall.start_m.y()}];
    ++ends[{wall.end_m.x(), wall.end_m.y()}];
  }
  EXPECT_EQ(starts, ends);
  for (const auto& [place, count] : starts) EXPECT_EQ(count, 1);
}

TEST_P(DrawnPlan, SightAlwaysEndsOnTheWallItNamesAndCrossesFreeSpaceOnly) {
  Random random(5, "rays");
  const Rectangle bounds = plan_.bounds();
  int rays = 0;
  while (rays < 2000) {
    const Vector2d eye(random.uniform(bounds.min_m.x(), bounds.max_m.x()),
                       random.uniform(bounds.min_m.y(), bounds.max_m.y()));
    if (!plan_.contains(eye)) continue;
    ++rays;
    const double angle = random.uniform(0.0, 2.0 * kPi);
    const Vector2d direction(std::cos(angle), std::sin(angle));
    const WallHit hit = plan_.cast(eye, direction);
    ASSERT_GE(hit.wall, 0);
    const Wall& wall = plan_.walls()[static_cast<std::size_t>(hit.wall)];
    const Vector2d point = eye + hit.distance * direction;
    EXPECT_NEAR((point - wall.start_m).dot(wall.normal), 0.0, 1e-9);
    const double along = (point - wall.start_m).dot(wall.end_m - wall.start_m);
    EXPECT_GE(along, -1e-6);
    EXPECT_LE(along, (wall.end_m - wall.start_m).squaredNorm() + 1e-6);
    EXPECT_LT(direction.dot(wall.normal), 0.0);
    for (double share = 0.0; share < 0.999; share += 0.05) {
      EXPECT_TRUE(plan_.contains(eye + share * hit.distance * direction));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, DrawnPlan, testing::Range(1, 6));

}  // namespace
}  // namespace vpdr::simulation
