#include <gtest/gtest.h>

#include <numbers>

#include "simulation/render/ray_table.hpp"
#include "simulation/render/scene_renderer.hpp"
#include "simulation/render/solid.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector3f;

Solid box() {  // 1 m deep, 2 m wide, 0.5 m high, 3 m east of the origin
  Solid solid;
  solid.foot_m = {3.0F, 0.0F, 0.0F};
  solid.size_m = {1.0F, 2.0F, 0.5F};
  return solid;
}

TEST(Solid, RaysEnterByHand) {
  const Solid solid = box();
  const SolidInView seen(solid, {0.0F, 0.0F, 0.25F});
  const auto front = seen.enter(seen.turned({2.0F, 0.0F, 0.0F}));
  EXPECT_NEAR(front.distance, 1.25F, 1e-6F);  // 2.5 m in lengths of 2
  EXPECT_EQ(front.axis, 0);
  EXPECT_LT(seen.enter(seen.turned({-1.0F, 0.0F, 0.0F})).distance, 0.0F);
  EXPECT_LT(seen.enter(seen.turned({1.0F, 0.0F, 0.2F})).distance, 0.0F);  // above it
  const SolidInView above(solid, {3.0F, 0.0F, 2.0F});
  const auto top = above.enter(above.turned({0.0F, 0.0F, -1.0F}));
  EXPECT_NEAR(top.distance, 1.5F, 1e-6F);
  EXPECT_EQ(top.axis, 2);
  const SolidInView inside(solid, {3.0F, 0.0F, 0.2F});
  EXPECT_LT(inside.enter(inside.turned({1.0F, 0.0F, 0.0F})).distance, 0.0F);
}

TEST(Solid, ATurnedBoxIsEnteredByItsOtherSide) {
  Solid solid = box();
  solid.yaw_rad = 0.5F * std::numbers::pi_v<float>;  // now 2 m deep seen from the west
  const SolidInView seen(solid, {0.0F, 0.0F, 0.25F});
  const auto front = seen.enter(seen.turned({1.0F, 0.0F, 0.0F}));
  EXPECT_NEAR(front.distance, 2.0F, 1e-5F);
  EXPECT_EQ(front.axis, 1);
}

TEST(Solid, TilesOverlookNothing) {
  // Every pixel that looks into a ball lies in a tile that says so, through a lens of any kind.
  Camera fisheye;
  fisheye.lens = Lens::kEquidistant;
  fisheye.width = fisheye.height = 200;
  fisheye.fx = fisheye.fy = 75.0;
  fisheye.cx = fisheye.cy = 99.5;
  fisheye.distortion = {};
  for (const Camera& camera : {Camera{}, fisheye}) {
    const RayTable rays(camera);
    for (const Vector3f& middle : {Vector3f(0.3F, 0.2F, 2.0F), Vector3f(-1.5F, 0.4F, 1.0F),
                                   Vector3f(0.0F, 1.2F, 0.1F), Vector3f(0.2F, 0.1F, 0.3F)}) {
      const Ball ball{middle, 0.3F};
      int seen = 0, unseen_tiles = 0;
      for (int row = 0; row < camera.height; ++row) {
        for (int column = 0; column < camera.width; ++column) {
          const int tile = row / RayTable::kTile * rays.tile_columns() + column / RayTable::kTile;
          unseen_tiles += rays.may_see(tile, ball) ? 0 : 1;
          const float along = rays.row(row)[column].dot(middle);
          if (along < 0.0F || middle.squaredNorm() - along * along > 0.3F * 0.3F) continue;
          ++seen;
          EXPECT_TRUE(rays.may_see(tile, ball));
        }
      }
      if (seen > 0 && middle.norm() > 1.0F) {
        EXPECT_GT(unseen_tiles, 100);  // it does look only where it must
      }
    }
  }
}

TEST(Solid, StandsInThePictureAtItsDistance) {
  Camera camera;
  camera.width = 160;
  camera.height = 120;
  camera.fx = camera.fy = 115.0;
  camera.cx = 79.5;
  camera.cy = 59.5;
  camera.distortion = {};
  const SceneRenderer renderer(FloorPlan({{{-2.0, -3.0}, {12.0, 3.0}}}), camera, 3, {}, {box()});
  Eigen::Isometry3d pose = Camera::looking_ahead({0.0, 0.0, 0.0}, 0.0);
  pose.translation() = Eigen::Vector3d(0.0, 0.0, 1.0);
  const cv::Mat ranges = renderer.ranges(pose);
  // Its upper front edge is 2.5 m ahead and 0.5 m down: 23 pixels below the middle. Below that
  // edge the front face, above it the lid, seen at 1 m from the floor less 0.5 m.
  const Eigen::Vector3d front = camera.ray({79.0, 90.0}), lid = camera.ray({79.0, 79.0});
  EXPECT_NEAR(ranges.at<float>(90, 79), 2.5 / front.z(), 1e-3);
  EXPECT_NEAR(ranges.at<float>(79, 79), 0.5 / lid.y(), 1e-3);
  EXPECT_NEAR(ranges.at<float>(60, 79), 12.0, 0.01);  // over it to the end wall
}

}  // namespace
}  // namespace vpdr::simulation
