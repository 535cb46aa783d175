#include <gtest/gtest.h>

#include <cmath>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "simulation/walking_path.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;

TEST(WalkingPath, AStraightLegIsWalkedStraight) {
  const WalkingPath path({{1.0, 2.0}, {1.0, 7.0}});
  EXPECT_DOUBLE_EQ(path.length_m(), 5.0);
  const PathPoint middle = path.at(2.5);
  EXPECT_TRUE(middle.position_m.isApprox(Vector2d(1.0, 4.5)));
  EXPECT_DOUBLE_EQ(middle.heading_rad, kPi / 2);
  EXPECT_DOUBLE_EQ(middle.curvature_per_m, 0.0);
}

TEST(WalkingPath, ACornerIsRoundedAndBothLegsAreMet) {
  const WalkingPath path({{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}}, 2.6);
  EXPECT_TRUE(path.at(5.0).position_m.isApprox(Vector2d(5.0, 0.0)));
  const PathPoint end = path.at(path.length_m());
  EXPECT_NEAR((end.position_m - Vector2d(10.0, 10.0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(end.heading_rad, kPi / 2, 1e-12);
  // Shorter than round the corner, longer than the straight cut.
  EXPECT_LT(path.length_m(), 20.0);
  EXPECT_GT(path.length_m(), 18.5);
  // Symmetric: half-way it heads north-east and lies on the corner's bisector.
  const PathPoint half = path.at(0.5 * path.length_m());
  EXPECT_NEAR(half.heading_rad, kPi / 4, 1e-9);
  EXPECT_NEAR((10.0 - half.position_m.x()) - half.position_m.y(), 0.0, 1e-8);
}

TEST(WalkingPath, HeadingIsTheDirectionOfTravelAndCurvatureItsRate) {
  const WalkingPath path({{0.0, 0.0}, {6.0, 0.0}, {6.0, -5.0}, {12.0, -5.0}, {12.0, 0.0}});
  const double h = 1e-4;
  for (double s = 0.05; s < path.length_m() - 0.05; s += 0.07) {
    const PathPoint a = path.at(s - h), b = path.at(s + h), here = path.at(s);
    const Vector2d moved = (b.position_m - a.position_m) / (2.0 * h);
    EXPECT_NEAR(moved.x(), std::cos(here.heading_rad), 1e-7) << s;
    EXPECT_NEAR(moved.y(), std::sin(here.heading_rad), 1e-7) << s;
    EXPECT_NEAR((b.heading_rad - a.heading_rad) / (2.0 * h), here.curvature_per_m, 1e-4) << s;
  }
}

TEST(WalkingPath, TurningBackTakesTwoQuarterTurns) {
  const WalkingPath path({{0.0, 0.0}, {8.0, 0.0}, {0.0, 0.0}});
  const PathPoint end = path.at(path.length_m());
  EXPECT_NEAR(end.position_m.norm(), 0.0, 1e-6);
  EXPECT_NEAR(std::abs(end.heading_rad), kPi, 0.15);
  for (double s = 0.0; s < path.length_m(); s += 0.1) {
    EXPECT_LT(std::abs(path.at(s).position_m.y()), 0.5);
  }
}

TEST(WalkingPath, PointsOnALineNeedNoTurn) {
  const WalkingPath path({{0.0, 0.0}, {3.0, 0.0}, {9.0, 0.0}});
  EXPECT_NEAR(path.length_m(), 9.0, 1e-9);
  EXPECT_NEAR(path.at(4.0).position_m.x(), 4.0, 1e-9);
}

TEST(WalkingPath, RefusesASinglePointAndRepeatedOnes) {
  EXPECT_THROW(WalkingPath({{0.0, 0.0}}), ConfigurationFault);
  EXPECT_THROW(WalkingPath({{0.0, 0.0}, {0.0, 0.0}}), ConfigurationFault);
}

}  // namespace
}  // namespace vpdr::simulation
