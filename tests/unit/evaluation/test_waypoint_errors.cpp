#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluation/waypoint_errors.hpp"

namespace vpdr::evaluation {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;

std::vector<StampedPose> straight_east() {
  std::vector<StampedPose> poses;
  for (int i = 0; i <= 10; ++i) {
    poses.push_back({i * kNsPerSecond, {static_cast<double>(i), 0.0, 9.0}, {}});
  }
  return poses;
}

TEST(WaypointErrors, StartsOnTheFirstWaypointWithoutRotation) {
  // At 0.5 s the estimate is at (0.5, 0) and is moved to (100, 50). At 4.5 s it is then at
  // (104, 50), at 9.5 s at (109, 50).
  const std::vector<dataset::Waypoint> waypoints = {{kNsPerSecond / 2, {100.0, 50.0}},
                                                    {9 * kNsPerSecond / 2, {104.0, 53.0}},
                                                    {19 * kNsPerSecond / 2, {104.0, 62.0}}};
  const auto errors = waypoint_errors(straight_east(), waypoints);
  ASSERT_TRUE(errors.has_value());
  EXPECT_THAT(errors->each_m, ElementsAre(0.0, DoubleNear(3.0, 1e-9), DoubleNear(13.0, 1e-9)));
  EXPECT_NEAR(errors->mean_m, 8.0, 1e-9);
  EXPECT_NEAR(errors->max_m, 13.0, 1e-9);
  EXPECT_NEAR(errors->final_m, 13.0, 1e-9);
  EXPECT_NEAR(errors->path_m, 14.0, 1e-9);  // 5 + 9
  EXPECT_NEAR(errors->final_percent, 1300.0 / 14.0, 1e-9);
}

TEST(WaypointErrors, OutsideTheEstimateItsEndsHold) {
  const std::vector<dataset::Waypoint> waypoints = {{-5 * kNsPerSecond, {0.0, 0.0}},
                                                    {99 * kNsPerSecond, {10.0, 1.0}}};
  EXPECT_NEAR(waypoint_errors(straight_east(), waypoints)->final_m, 1.0, 1e-9);
}

TEST(WaypointErrors, NeedsTwoWaypointsAndAnEstimate) {
  EXPECT_FALSE(waypoint_errors(straight_east(), {{0, {0.0, 0.0}}}).has_value());
  EXPECT_FALSE(waypoint_errors({}, {{0, {0.0, 0.0}}, {1, {1.0, 0.0}}}).has_value());
}

}  // namespace
}  // namespace vpdr::evaluation
