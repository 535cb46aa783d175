#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulation/stairs.hpp"
#include "simulation/walk.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;

TEST(Flight, TreadsClimbAStorey) {
  const Flight flight{10.0, 4.0, 3.0};
  const auto treads = treads_of(flight, 2.7);
  ASSERT_EQ(treads.size(), 17u);
  EXPECT_NEAR(treads.front().floor_m, 3.0 + 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(treads.back().floor_m, 6.0 - 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(treads.back().max_m.x(), 15.1, 1e-12);
  for (const Rectangle& tread : treads) EXPECT_NEAR(tread.floor_m + tread.height_m, 8.7, 1e-12);
}

TEST(Ground, RisesByHand) {
  const Ground ground({Flight{10.0, 0.0, -3.0}}, -3.0);
  EXPECT_NEAR(ground.at({9.0, 0.0}), -3.0, 1e-12);
  EXPECT_NEAR(ground.at({16.0, 0.0}), 0.0, 1e-12);
  // The ramp runs from 9.85 to 15.25: half-way is half the height, and it climbs 5 in 9.
  EXPECT_NEAR(ground.at({12.55, 0.0}), -1.5, 1e-12);
  EXPECT_NEAR(ground.at({13.0, 0.0}) - ground.at({12.1, 0.0}), 0.5, 1e-12);
  EXPECT_TRUE(ground.is_stairs({9.9, 0.5}));
  EXPECT_FALSE(ground.is_stairs({9.9, 1.5}));
  EXPECT_FALSE(ground.is_stairs({15.2, 0.0}));
}

TEST(Ground, IsLevelWithoutStairs) {
  EXPECT_EQ(Ground().at({3.0, 7.0}), 0.0);
  EXPECT_FALSE(Ground().is_stairs({3.0, 7.0}));
}

TEST(Ground, IsWhereTheTreadsAre) {
  const Flight flight{0.0, 0.0, 0.0};
  const Ground ground({flight});
  for (const Rectangle& tread : treads_of(flight, 2.7)) {
    const double middle = 0.5 * (tread.min_m.x() + tread.max_m.x());
    EXPECT_NEAR(ground.at({middle, 0.0}), tread.floor_m, 0.03);
  }
}

/// A walk through a building of two storeys.
class ClimbingWalk : public testing::TestWithParam<int> {
 protected:
  static SimulatedWalk walk() {
    WalkOptions options;
    options.seed = static_cast<std::uint64_t>(GetParam());
    options.duration_s = 120.0;
    options.building.storeys = 2;
    options.errors = SensorErrors::none();
    return simulate_walk(options);
  }
};

TEST_P(ClimbingWalk, ChangesStoreyAndThePressureFollows) {
  const SimulatedWalk walk = ClimbingWalk::walk();
  double least = 1e9, most = -1e9;
  const double standing = walk.state_at(walk.pressure.front().stamp_ns).position_m.z();
  for (const PressureSample& sample : walk.pressure) {
    const double z = walk.state_at(sample.stamp_ns).position_m.z();
    least = std::min(least, z);
    most = std::max(most, z);
    // 12.0 Pa a metre at sea level.
    EXPECT_NEAR(sample.pressure_pa - walk.pressure.front().pressure_pa, -12.0 * (z - standing),
                0.5);
  }
  EXPECT_NEAR(most - least, Flight::kStoreyM, 0.15);
}

TEST_P(ClimbingWalk, TakesATreadAStep) {
  const SimulatedWalk walk = ClimbingWalk::walk();
  int on_stairs = 0;
  for (const TrueStep& step : walk.steps) {
    const Vector2d foot = walk.state_at(step.stamp_ns).position_m.head<2>();
    if (!walk.ground.is_stairs(foot - Vector2d(0.45, 0.0)) ||
        !walk.ground.is_stairs(foot + Vector2d(0.45, 0.0))) {
      continue;
    }
    ++on_stairs;
    EXPECT_NEAR(step.length_m, Flight::kGoingM, 0.03);
  }
  EXPECT_GE(on_stairs, 12);
}

TEST_P(ClimbingWalk, KeepsItsHeadBetweenFloorAndCeiling) {
  const SimulatedWalk walk = ClimbingWalk::walk();
  for (const TimestampNs stamp : walk.frames) {
    const Eigen::Vector3d eye = walk.world_from_camera(stamp).translation();
    const int cell = walk.plan.cell_at(eye.head<2>());
    ASSERT_GE(cell, 0);
    const Cell& here = walk.plan.cell(cell);
    EXPECT_GT(eye.z() - here.floor_m, 1.2);
    EXPECT_LT(eye.z() - here.floor_m, 2.1);
    EXPECT_LT(eye.z(), here.ceiling_m - 0.3);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, ClimbingWalk, testing::Range(1, 5));

TEST(SimulatedWalk, OnOneStoreyStaysLevel) {
  WalkOptions options;
  options.duration_s = 40.0;
  const SimulatedWalk walk = simulate_walk(options);
  EXPECT_TRUE(walk.ground.flights().empty());
  for (const TimestampNs stamp : walk.frames) {
    EXPECT_NEAR(walk.state_at(stamp).position_m.z(), 1.65, 0.15);
  }
}

TEST(Stairs, TheFieldIsAsIndoorsOnEveryStorey) {
  WalkOptions options;
  options.seed = 3;  // down and down again
  options.duration_s = 300.0;
  options.building.storeys = 4;
  options.imu_rate_hz = 10.0;
  options.camera_rate_hz = 0.0;
  options.mag_rate_hz = 10.0;
  const SimulatedWalk walk = simulate_walk(options);
  double lowest = 0.0;
  for (const MagSample& sample : walk.mag) {
    EXPECT_NEAR(sample.field_ut.norm(), 48.0, 15.0);
    lowest = std::min(lowest, walk.state_at(sample.stamp_ns).position_m.z());
  }
  EXPECT_LT(lowest, -1.0);
}

}  // namespace
}  // namespace vpdr::simulation
