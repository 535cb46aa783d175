#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "tests/unit/vision/corridor_image.hpp"
#include "vision/core/camera_model.hpp"

namespace vpdr::vision {
namespace {

CameraParameters lens(Distortion distortion, std::array<double, 5> coefficients) {
  CameraParameters p = testing::plain_camera();
  p.distortion = distortion;
  p.coefficients = coefficients;
  return p;
}

TEST(CameraModel, PinholeByHand) {
  CameraParameters p;
  p.fx_px = 400.0;
  p.fy_px = 300.0;
  p.cx_px = 320.0;
  p.cy_px = 240.0;
  const CameraModel camera(p);
  EXPECT_TRUE(camera.ray({320.0, 240.0}).isApprox(Eigen::Vector3d(0, 0, 1), 1e-15));
  // 300 px right at fx 400: x/z = 3/4, so the ray is (3, 0, 4) / 5.
  EXPECT_TRUE(camera.ray({620.0, 240.0}).isApprox(Eigen::Vector3d(0.6, 0, 0.8), 1e-15));
  EXPECT_TRUE(camera.pixel({0.0, 2.0, 1.0})->isApprox(Eigen::Vector2d(320.0, 840.0), 1e-12));
  EXPECT_FALSE(camera.pixel({0.0, 0.0, -1.0}));
  EXPECT_FALSE(camera.pixel({1.0, 0.0, 0.0}));
}

TEST(CameraModel, RadialTangentialByHand) {
  CameraParameters p = lens(Distortion::kRadialTangential, {0.1, 0.01, 0.001, 0.002, 0.05});
  p.fx_px = p.fy_px = 100.0;
  p.cx_px = p.cy_px = 0.0;
  // At (0.5, 0): r2 = 0.25, radial = 1 + 0.025 + 0.000625 + 0.00078125 = 1.02640625;
  // x = 0.513203125 + 0.002 (0.25 + 0.5) = 0.514703125, y = 0.001 * 0.25 = 0.00025.
  const auto pixel = CameraModel(p).pixel({0.5, 0.0, 1.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 51.4703125, 1e-10);
  EXPECT_NEAR(pixel->y(), 0.025, 1e-12);
}

TEST(CameraModel, EquidistantByHand) {
  CameraParameters p = lens(Distortion::kEquidistant, {0.01, 0.0, 0.0, 0.0, 0.0});
  p.fx_px = p.fy_px = 300.0;
  p.cx_px = 320.0;
  p.cy_px = 240.0;
  // 90 degrees to the right: radius = pi/2 + 0.01 (pi/2)^3 = 1.60955...
  const double half_pi = 0.5 * kPi;
  const auto pixel = CameraModel(p).pixel({1.0, 0.0, 0.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 320.0 + 300.0 * (half_pi + 0.01 * half_pi * half_pi * half_pi), 1e-9);
  EXPECT_NEAR(pixel->y(), 240.0, 1e-12);
}

class EveryLens : public ::testing::TestWithParam<CameraParameters> {};

TEST_P(EveryLens, PixelToRayAndBackOverTheWholeImage) {
  CameraParameters p = GetParam();
  p.fx_px = p.fy_px = 537.0;
  const CameraModel camera(p);
  for (double y = 0.0; y < 480.0; y += 23.0) {
    for (double x = 0.0; x < 640.0; x += 23.0) {
      const Eigen::Vector3d ray = camera.ray({x, y});
      EXPECT_NEAR(ray.norm(), 1.0, 1e-12);
      const auto back = camera.pixel(ray);
      ASSERT_TRUE(back);
      EXPECT_NEAR(back->x(), x, 1e-7);
      EXPECT_NEAR(back->y(), y, 1e-7);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Lenses, EveryLens,
    ::testing::Values(
        lens(Distortion::kNone, {}),
        lens(Distortion::kRadialTangential, {-0.28340811, 0.07395907, 0.00019359, 1.76e-05, 0.0}),
        lens(Distortion::kRadialTangential, {0.0354, -0.0476, 0.0010, 0.0012, -0.2070}),
        lens(Distortion::kEquidistant, {-0.013, 0.02, -0.012, 0.0025, 0.0})));

TEST(CameraModel, ForwardLookingAxes) {
  const Eigen::Matrix3d r = forward_looking_body_from_camera();
  EXPECT_NEAR(r.determinant(), 1.0, 1e-15);
  EXPECT_EQ(r * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX());   // optical axis: forward
  EXPECT_EQ(r * Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY());  // right: minus left
  EXPECT_EQ(r * Eigen::Vector3d::UnitY(), -Eigen::Vector3d::UnitZ());  // down: minus up
}

TEST(CameraModel, UndistortedPixelIgnoresTheLens) {
  const CameraModel camera(lens(Distortion::kRadialTangential, {-0.3, 0.1, 0.0, 0.0, 0.0}));
  const auto pixel = camera.undistorted_pixel({0.2, -0.1, 1.0});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 319.5 + 100.0, 1e-10);
  EXPECT_NEAR(pixel->y(), 239.5 - 50.0, 1e-10);
  EXPECT_FALSE(camera.undistorted_pixel({0.2, -0.1, -1.0}));
}

}  // namespace
}  // namespace vpdr::vision
