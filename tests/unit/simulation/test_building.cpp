#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "simulation/building.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;

bool on_tiles(double value) { return std::abs(value / kTileM - std::round(value / kTileM)) < 1e-6; }

TEST(Building, HasNoDeadEndAndIsOfPlausibleSize) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed, "building test");
    const Building building = draw_building({}, random);
    for (const auto& neighbours : building.network.neighbours) EXPECT_GE(neighbours.size(), 2u);
    for (const Vector2d& crossing : building.network.crossings_m) {
      EXPECT_TRUE(on_tiles(crossing.x()) && on_tiles(crossing.y()));
    }
    const Rectangle bounds = FloorPlan(building.corridors).bounds();
    const Vector2d size = bounds.max_m - bounds.min_m;
    EXPECT_GT(size.x(), 38.0);
    EXPECT_LT(size.x(), 65.0);
    EXPECT_GT(size.y(), 28.0);
    EXPECT_LT(size.y(), 50.0);
  }
}

TEST(Building, CorridorsJoinTheCrossingsThatTheNetworkJoins) {
  Random random(3, "building test");
  const Building building = draw_building({}, random);
  const FloorPlan plan(building.corridors);
  const auto& crossings = building.network.crossings_m;
  for (std::size_t a = 0; a < crossings.size(); ++a) {
    for (const int b : building.network.neighbours[a]) {
      const Vector2d way = crossings[static_cast<std::size_t>(b)] - crossings[a];
      EXPECT_GE(plan.cast(crossings[a], way).distance, 1.0);
    }
  }
}

TEST(Building, LeavesOutTheShareAskedFor) {
  BuildingOptions options;
  options.left_out_share = 0.0;
  Random random(1, "building test");
  const Building full = draw_building(options, random);
  std::size_t ends = 0;
  for (const auto& neighbours : full.network.neighbours) ends += neighbours.size();
  EXPECT_EQ(ends, 2u * (4u * 4u + 5u * 3u));
}

TEST(Building, RefusesSizesThatMakeNone) {
  Random random(1, "building test");
  BuildingOptions one;
  one.east_west_corridors = 1;
  EXPECT_THROW(draw_building(one, random), ConfigurationFault);
  BuildingOptions narrow;
  narrow.min_block_m = 2.0;
  EXPECT_THROW(draw_building(narrow, random), ConfigurationFault);
}

TEST(Route, TurnsAtRightAnglesAlongCorridorsAndKeepsToItsLength) {
  Random random(2, "route test");
  const Building building = draw_building({}, random);
  const FloorPlan plan(building.corridors);
  int closed = 0;
  for (int i = 0; i < 500; ++i) {
    const Route route = draw_route(building.network, 120.0, random);
    EXPECT_LE(route.length_m, 120.0 + 1e-9);
    EXPECT_EQ(route.turns, static_cast<int>(route.corners_m.size()) - 2);
    for (std::size_t k = 1; k < route.corners_m.size(); ++k) {
      const Vector2d leg = route.corners_m[k] - route.corners_m[k - 1];
      EXPECT_LT(leg.cwiseAbs().minCoeff(), 1e-9);
      EXPECT_GT(plan.cast(route.corners_m[k - 1], leg).distance, 1.0);
      if (k > 1) {
        const Vector2d before = route.corners_m[k - 1] - route.corners_m[k - 2];
        EXPECT_NEAR(before.dot(leg), 0.0, 1e-9);
      }
    }
    if (!route.closed) continue;
    ++closed;
    EXPECT_TRUE(route.corners_m.front().isApprox(route.corners_m.back()));
    const Vector2d out = route.corners_m[1] - route.corners_m[0];
    const Vector2d home = route.corners_m.back() - route.corners_m[route.corners_m.size() - 2];
    EXPECT_GT(out.dot(home), 0.0);
  }
  EXPECT_GT(closed, 5);
}

TEST(Route, CorridorsAreBuiltAroundGivenWaypoints) {
  const auto bend = corridors_around({{0.0, 0.0}, {5.0, 0.0}, {5.0, 4.0}}, 2.0);
  ASSERT_EQ(bend.size(), 2u);
  EXPECT_TRUE(bend[0].min_m.isApprox(Vector2d(-1.0, -1.0)));
  EXPECT_TRUE(bend[0].max_m.isApprox(Vector2d(6.0, 1.0)));
  const auto hall = corridors_around({{0.0, 0.0}, {5.0, 3.0}}, 2.0);
  ASSERT_EQ(hall.size(), 1u);
  EXPECT_TRUE(hall[0].max_m.isApprox(Vector2d(7.0, 5.0)));
}

}  // namespace
}  // namespace vpdr::simulation
