#include "simulation/camera.hpp"

#include <gtest/gtest.h>

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

TEST(Camera, ProjectsByHand) {
  Camera camera;
  camera.distortion = {0.0, 0.0, 0.0, 0.0};
  const auto pixel = camera.project({0.5, -0.25, 2.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 319.5 + 460.0 * 0.25, 1e-12);
  EXPECT_NEAR(pixel->y(), 239.5 - 460.0 * 0.125, 1e-12);
  EXPECT_FALSE(camera.project({0.0, 0.0, -1.0}));
}

TEST(Camera, DistortsByHand) {
  Camera camera;
  camera.distortion = {-0.1, 0.01, 0.001, -0.002};
  // r2 = 0.25; radial 1 - 0.025 + 0.000625 = 0.975625
  // x: 0.3 * 0.975625 + 2 * 0.001 * 0.12 - 0.002 * (0.25 + 0.18) = 0.2920675
  // y: 0.4 * 0.975625 + 0.001 * (0.25 + 0.32) - 2 * 0.002 * 0.12 = 0.39034
  const Vector2d d = camera.distort({0.3, 0.4});
  EXPECT_NEAR(d.x(), 0.2920675, 1e-9);
  EXPECT_NEAR(d.y(), 0.39034, 1e-9);
}

TEST(Camera, UndistortsWhatItDistorts) {
  const Camera camera;
  for (double u = 0.0; u < 640.0; u += 63.9) {
    for (double v = 0.0; v < 480.0; v += 47.9) {
      const Vector2d d = camera.distort(camera.normalised({u, v}));
      EXPECT_NEAR(camera.fx * d.x() + camera.cx, u, 1e-9);
      EXPECT_NEAR(camera.fy * d.y() + camera.cy, v, 1e-9);
    }
  }
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
