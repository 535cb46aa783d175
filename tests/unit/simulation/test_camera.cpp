#include <gtest/gtest.h>

#include "simulation/camera.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector3d;

TEST(Camera, ProjectsByHand) {
  Camera camera;
  camera.distortion = {};
  const auto pixel = camera.project({0.5, -0.25, 2.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 319.5 + 460.0 * 0.25, 1e-12);
  EXPECT_NEAR(pixel->y(), 239.5 - 460.0 * 0.125, 1e-12);
  EXPECT_FALSE(camera.project({0.0, 0.0, -1.0}));
}

TEST(Camera, DistortsByHand) {
  Camera camera;
  camera.distortion = {-0.1, 0.01, 0.001, -0.002, 0.008};
  // r2 = 0.25; radial 1 - 0.025 + 0.000625 + 0.000125 = 0.97575
  // x: 0.3 * 0.97575 + 2 * 0.001 * 0.12 - 0.002 * (0.25 + 0.18) = 0.292105
  // y: 0.4 * 0.97575 + 0.001 * (0.25 + 0.32) - 2 * 0.002 * 0.12 = 0.39039
  const auto pixel = camera.project({0.6, 0.8, 2.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 319.5 + 460.0 * 0.292105, 1e-9);
  EXPECT_NEAR(pixel->y(), 239.5 + 460.0 * 0.39039, 1e-9);
}

Camera fisheye() {
  Camera camera;
  camera.lens = Lens::kEquidistant;
  camera.width = camera.height = 512;
  camera.fx = camera.fy = 191.0;
  camera.cx = 255.0;
  camera.cy = 257.0;
  camera.distortion = {0.0035, 0.0007, -0.0021, 0.0002, 0.0};
  return camera;
}

TEST(Camera, AFisheyeDistortsByHand) {
  Camera camera = fisheye();
  camera.distortion = {0.01, -0.002, 0.0, 0.0, 0.0};
  // 45 degrees to the right: a = 0.785398, a2 = 0.616850; a (1 + 0.0061685 - 0.000761) = 0.789645
  const auto right = camera.project({1.0, 0.0, 1.0});
  ASSERT_TRUE(right);
  EXPECT_NEAR(right->x(), 255.0 + 191.0 * 0.789645, 2e-4);
  EXPECT_NEAR(right->y(), 257.0, 1e-12);
  // 90 degrees down, which no pinhole sees: a = 1.570796, a2 = 2.467401;
  // a (1 + 0.024674 - 0.012176) = 1.590428
  const auto down = camera.project({0.0, 3.0, 0.0});
  ASSERT_TRUE(down);
  EXPECT_NEAR(down->x(), 255.0, 1e-12);
  EXPECT_NEAR(down->y(), 257.0 + 191.0 * 1.590428, 2e-4);
  EXPECT_FALSE(camera.project({0.0, 0.0, -1.0}));
}

TEST(Camera, RaysProjectBackIntoTheirPixels) {
  Camera wide;  // a lens that bends a lot
  wide.distortion = {-0.28, 0.07, 0.0002, 0.00002, 0.0};
  for (const Camera& camera : {Camera{}, wide, fisheye()}) {
    for (double u = 0.0; u < camera.width; u += 63.9) {
      for (double v = 0.0; v < camera.height; v += 47.9) {
        const Vector3d ray = camera.ray({u, v});
        EXPECT_NEAR(ray.norm(), 1.0, 1e-12);
        const auto pixel = camera.project(7.0 * ray);
        ASSERT_TRUE(pixel);
        EXPECT_NEAR(pixel->x(), u, 1e-9);
        EXPECT_NEAR(pixel->y(), v, 1e-9);
      }
    }
  }
  EXPECT_LT(fisheye().ray({0.0, 0.0}).z(), 0.0);  // its corner looks back
}

TEST(Camera, LooksForwardAndDown) {
  const Eigen::Isometry3d body_from_camera = Camera::looking_ahead({0.0, 0.0, 0.0}, 0.1);
  const Vector3d view = body_from_camera.linear() * Vector3d::UnitZ();
  EXPECT_NEAR(view.x(), std::cos(0.1), 1e-12);
  EXPECT_NEAR(view.z(), -std::sin(0.1), 1e-12);
  const Vector3d right = body_from_camera.linear() * Vector3d::UnitX();
  EXPECT_NEAR((right - Vector3d(0.0, -1.0, 0.0)).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace vpdr::simulation
