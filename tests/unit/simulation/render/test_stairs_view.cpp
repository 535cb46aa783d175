// What a camera sees of stairs and of rooms of unlike height.
#include <gtest/gtest.h>

#include <opencv2/core/mat.hpp>

#include "simulation/render/scene_renderer.hpp"
#include "simulation/stairs.hpp"

namespace vpdr::simulation {
namespace {

Camera straight_camera() {
  Camera camera;
  camera.width = 160;
  camera.height = 240;
  camera.fx = camera.fy = 115.0;
  camera.cx = 79.5;
  camera.cy = 119.5;
  camera.distortion = {};
  return camera;
}

/// A corridor, a flight up from x = 4, a landing of 3 m.
FloorPlan flight_of_stairs() {
  const Flight flight{4.0, 0.0, 0.0};
  std::vector<Rectangle> parts = treads_of(flight, 2.7);
  parts.push_back({{-2.0, -1.0}, {4.0, 1.0}});
  parts.push_back({{flight.head_x_m(), -1.0}, {flight.head_x_m() + 3.0, 1.0}, Flight::kStoreyM});
  return FloorPlan(parts);
}

Eigen::Isometry3d eye_at(double x, double z) {
  Eigen::Isometry3d pose = Camera::looking_ahead({0.0, 0.0, 0.0}, 0.0);
  pose.translation() = Eigen::Vector3d(x, 0.01, z);
  return pose;
}

double sees_at(const SceneRenderer& renderer, const Eigen::Isometry3d& pose, int row) {
  return renderer.ranges(pose).at<float>(row, 79) * renderer.camera().ray({79.0, row}).z();
}

TEST(StairsInView, RisersAndTreadsByHand) {
  const SceneRenderer renderer(flight_of_stairs(), straight_camera(), 1);
  const Eigen::Isometry3d pose = eye_at(2.0, 1.5);
  // Level, 1.5 m up: the riser of the ninth step, from 8/6 to 9/6 m, 2 + 8 * 0.3 m ahead.
  EXPECT_NEAR(sees_at(renderer, pose, 120), 4.4, 1e-3);
  // 80 pixels down: 1.5 m below lies 1.5 * 115 / 79.5 = 2.17 m ahead, behind the first riser.
  EXPECT_NEAR(sees_at(renderer, pose, 199), 2.0, 1e-3);
  // 115 pixels down: the corridor's floor before it.
  EXPECT_NEAR(sees_at(renderer, pose, 234), 1.5 * 115.0 / 114.5, 1e-3);
}

TEST(StairsInView, TheLintelHidesTheUpperCeiling) {
  const SceneRenderer renderer(flight_of_stairs(), straight_camera(), 1);
  const Eigen::Isometry3d pose = eye_at(2.0, 1.5);
  // 80 pixels up: the ceiling at 2.7 m begins 1.2 * 115 / 79.5 = 1.74 m ahead.
  EXPECT_NEAR(sees_at(renderer, pose, 40), 1.2 * 115.0 / 79.5, 1e-3);
  // 60 pixels up: under the ceiling's edge, 2 m ahead, into the well: over 2 m at 1.5 + 2 * 0.517;
  // the line climbs as the stairs do, 0.517 a metre, and meets a riser of the upper part.
  const double far = sees_at(renderer, pose, 60);
  EXPECT_GT(far, 5.0);
  EXPECT_LT(far, 2.0 + 17 * 0.3 + 3.0 + 1e-3);
}

TEST(StairsInView, FromTheLandingOneLooksDownAndAtTheLintel) {
  const SceneRenderer renderer(flight_of_stairs(), straight_camera(), 1);
  Eigen::Isometry3d pose = eye_at(10.0, 4.5);
  pose.linear() = Eigen::AngleAxisd(3.14159265358979, Eigen::Vector3d::UnitZ()) * pose.linear();
  // Looking back level at 4.5 m: the wall above the corridor's ceiling of 2.7 m, at x = 4.
  EXPECT_NEAR(sees_at(renderer, pose, 119), 6.0, 1e-3);
  // 114.5 pixels down, over the landing's edge: the line meets the stairs' slope about 2.5 m ahead.
  EXPECT_NEAR(sees_at(renderer, pose, 234), 2.5, 0.35);
  // 80.5 pixels down: past all of them to the corridor's floor.
  EXPECT_NEAR(sees_at(renderer, pose, 200), 4.5 * 115.0 / 80.5, 1e-3);
}

TEST(StairsInView, SharpEdgesStandAgainstTheTreads) {
  const SceneRenderer renderer(flight_of_stairs(), straight_camera(), 1,
                               {1, ImageSensorOptions::quiet()});
  const cv::Mat image = renderer.render(eye_at(2.0, 1.5));
  // Down the middle the eye meets eight risers with dark nosings: as many dark-bright changes.
  int changes = 0;
  for (int row = 121; row < 215; ++row) {
    changes += image.at<std::uint8_t>(row, 79) + 25 < image.at<std::uint8_t>(row - 1, 79) ? 1 : 0;
  }
  EXPECT_GE(changes, 6);
}

}  // namespace
}  // namespace vpdr::simulation
