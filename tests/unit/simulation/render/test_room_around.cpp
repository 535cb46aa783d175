#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "simulation/render/room_around.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A way at constant height through corners, a pose every 5 cm and 50 ms.
std::vector<PathPose> way(const std::vector<Vector2d>& corners, double height) {
  std::vector<PathPose> poses;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Vector2d leg = corners[i] - corners[i - 1];
    const int count = static_cast<int>(leg.norm() / 0.05);
    for (int k = 0; k < count; ++k) {
      const Vector2d at = corners[i - 1] + leg * k / count;
      poses.push_back({static_cast<TimestampNs>(poses.size()) * 50'000'000,
                       {at.x(), at.y(), height},
                       from_euler({0.0, 0.0, std::atan2(leg.y(), leg.x())})});
    }
  }
  return poses;
}

void expect_room_for(const Surroundings& place, const ReferencePath& path, double beside) {
  for (const PathPose& pose : path.poses()) {
    const Vector3d at = place.from_world() * pose.position_m;
    EXPECT_GE(place.plan.clearance_m(at.head<2>()), beside);
    const int cell = place.plan.cell_at(at.head<2>());
    ASSERT_GE(cell, 0);
    EXPECT_GT(at.z(), place.plan.cell(cell).floor_m + 0.2);
    EXPECT_LT(at.z(), place.plan.cell(cell).ceiling_m - 0.5);
    for (const Solid& solid : place.furniture) {
      const Vector2d off = at.head<2>() - solid.foot_m.head<2>().cast<double>();
      EXPECT_GT(off.norm(), 0.5 * solid.size_m.head<2>().norm() + 0.3);
    }
  }
}

TEST(RoomAround, AShortPathStandsInAFurnishedRoomOnTheFloorOfTheWorld) {
  const ReferencePath path(way({{0.0, 0.0}, {3.0, 0.5}, {2.0, 2.5}, {0.0, 0.0}}, 1.3));
  const Surroundings place = surround(path, {});
  EXPECT_EQ(place.yaw_rad, 0.0);
  EXPECT_EQ(place.plan.walls().size(), 4u);
  EXPECT_EQ(place.plan.cell(0).floor_m, 0.0F);
  EXPECT_GT(place.furniture.size(), 4u);
  expect_room_for(place, path, 1.4);
}

TEST(RoomAround, APathFarFromZeroHasItsFloorBelowIt) {
  const ReferencePath path(way({{0.0, 0.0}, {3.0, 0.5}, {2.0, 2.5}}, -4.0));
  const Surroundings place = surround(path, {});
  EXPECT_NEAR(place.plan.cell(0).floor_m, -5.3, 1e-5);
  expect_room_for(place, path, 1.4);
}

TEST(RoomAround, ALongPathGoesAlongCorridorsInItsOwnDirection) {
  const double turn = 0.3;
  const auto at = [&](double along, double across) -> Vector2d {
    return {along * std::cos(turn) - across * std::sin(turn),
            along * std::sin(turn) + across * std::cos(turn)};
  };
  const ReferencePath path(way({at(0, 0), at(40, 0), at(40, 15), at(20, 15)}, 1.2));
  const Surroundings place = surround(path, {});
  EXPECT_NEAR(place.yaw_rad, turn, 0.02);
  EXPECT_GE(place.plan.walls().size(), 8u);
  expect_room_for(place, path, 0.8);
  // The block between the corridors is not free.
  const Vector3d inside = place.from_world() * Vector3d(at(20, 7).x(), at(20, 7).y(), 1.0);
  EXPECT_LT(place.plan.clearance_m(inside.head<2>()), -3.0);
}

TEST(RoomAround, AClimbNeedsAHighHall) {
  std::vector<PathPose> poses = way({{0.0, 0.0}, {30.0, 0.0}, {30.0, 8.0}}, 1.2);
  for (std::size_t k = 0; k < poses.size(); ++k) {
    poses[k].position_m.z() += 6.0 * static_cast<double>(k) / static_cast<double>(poses.size());
  }
  const ReferencePath path(poses);
  const Surroundings place = surround(path, {});
  EXPECT_EQ(place.plan.walls().size(), 4u);
  expect_room_for(place, path, 1.4);
}

TEST(RoomAround, TheShotFollowsThePathInThePlacesAxes) {
  const ReferencePath path(way({{0.0, 0.0}, {3.0, 0.0}}, 1.3));
  Surroundings place = surround(path, {});
  place.yaw_rad = 0.5 * kPi;
  Camera camera;
  camera.body_from_camera = Camera::looking_ahead({0.1, 0.0, 0.0}, 0.0);
  const Shot shot = shot_in(place, path, camera, 1, {});
  // 1 m east in the world, the camera 0.1 m ahead: south of the place's origin, looking south.
  const Eigen::Isometry3d pose = shot.world_from_camera(20 * 50'000'000);
  EXPECT_TRUE(pose.translation().isApprox(Vector3d(0.0, -1.1, 1.3), 1e-9));
  EXPECT_TRUE(pose.linear().col(2).isApprox(-Vector3d::UnitY(), 1e-9));
}

}  // namespace
}  // namespace vpdr::simulation
