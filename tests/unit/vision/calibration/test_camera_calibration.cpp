#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <random>

#include "core/rotation.hpp"
#include "vision/core/calibration/floor_board.hpp"
#include "vision/core/calibration/intrinsics.hpp"

namespace vpdr::vision {
namespace {

constexpr Chessboard kBoard{9, 6, 0.03};

CameraParameters true_camera(Distortion lens) {
  CameraParameters p;
  p.width_px = 640;
  p.height_px = 480;
  p.fx_px = 420.0;
  p.fy_px = 424.0;
  p.cx_px = 325.0;
  p.cy_px = 236.0;
  p.distortion = lens;
  if (lens == Distortion::kEquidistant) {
    p.fx_px = 280.0;
    p.fy_px = 281.0;
    p.coefficients = {-0.02, 0.01, -0.004, 0.001, 0.0};
  } else {
    p.coefficients = {-0.28, 0.08, 0.0005, -0.0007, 0.0};
  }
  return p;
}

std::optional<std::vector<cv::Point2f>> seen(const CameraModel& camera,
                                             const Eigen::Isometry3d& camera_from_board) {
  std::vector<cv::Point2f> out;
  for (const cv::Point3f& p : kBoard.points()) {
    const Eigen::Vector3d q = camera_from_board * Eigen::Vector3d(p.x, p.y, p.z);
    const auto pixel = camera.pixel(q);
    if (!pixel || q.z() < 0.05 || pixel->x() < 0.0 || pixel->x() > 639.0 || pixel->y() < 0.0 ||
        pixel->y() > 479.0) {
      return std::nullopt;
    }
    out.emplace_back(static_cast<float>(pixel->x()), static_cast<float>(pixel->y()));
  }
  return out;
}

std::vector<BoardView> views_of(const CameraModel& camera, double noise_px, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, noise_px);
  std::vector<BoardView> views;
  while (views.size() < 20) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() =
        exp_rotation({0.6 * u(random), 0.6 * u(random), 0.3 * u(random)}).toRotationMatrix();
    pose.translation() =
        Eigen::Vector3d(0.25 * u(random), 0.18 * u(random), 0.4 + 0.15 * u(random)) -
        pose.linear() * Eigen::Vector3d(0.12, 0.075, 0.0);
    auto corners = seen(camera, pose);
    if (!corners) continue;
    for (cv::Point2f& c : *corners) {
      c += cv::Point2f(static_cast<float>(noise(random)), static_cast<float>(noise(random)));
    }
    views.push_back({"view" + std::to_string(views.size()), std::move(*corners)});
  }
  return views;
}

class EveryLensCalibrated : public ::testing::TestWithParam<Distortion> {};

TEST_P(EveryLensCalibrated, TheCameraComesBackWithinItsSigma) {
  const CameraParameters truth = true_camera(GetParam());
  IntrinsicsConfig config;
  config.lens = GetParam();
  double squares = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const auto result =
        calibrate_intrinsics(views_of(CameraModel(truth), 0.2, seed), kBoard, {640, 480}, config);
    ASSERT_TRUE(result) << result.error().message;
    const IntrinsicsCalibration& c = result.value();
    EXPECT_NEAR(c.rms_px, 0.2 * std::sqrt(2.0), 0.04);
    EXPECT_LT(c.sigma.fx_px, 2.0);
    for (const double n :
         {(c.camera.fx_px - truth.fx_px) / c.sigma.fx_px,
          (c.camera.fy_px - truth.fy_px) / c.sigma.fy_px,
          (c.camera.cx_px - truth.cx_px) / c.sigma.cx_px,
          (c.camera.cy_px - truth.cy_px) / c.sigma.cy_px,
          (c.camera.coefficients[0] - truth.coefficients[0]) / c.sigma.coefficients[0]}) {
      squares += n * n;
      ++count;
    }
  }
  const double rms = std::sqrt(squares / count);
  EXPECT_GT(rms, 0.5);
  EXPECT_LT(rms, 1.6);
}

INSTANTIATE_TEST_SUITE_P(Lenses, EveryLensCalibrated,
                         ::testing::Values(Distortion::kRadialTangential,
                                           Distortion::kEquidistant));

TEST(Intrinsics, AViewThatDoesNotFitIsDroppedByName) {
  const CameraParameters truth = true_camera(Distortion::kRadialTangential);
  std::vector<BoardView> views = views_of(CameraModel(truth), 0.1, 3);
  for (std::size_t i = 0; i < views[7].corners.size(); i += 2) views[7].corners[i].x += 3.0F;
  const auto result = calibrate_intrinsics(views, kBoard, {640, 480}, {});
  ASSERT_TRUE(result);
  int dropped = 0;
  for (const ViewResidual& v : result.value().views) {
    dropped += v.dropped;
    EXPECT_EQ(v.dropped, v.name == "view7");
  }
  EXPECT_EQ(dropped, 1);
  EXPECT_NEAR(result.value().camera.fx_px, truth.fx_px, 2.0);
}

TEST(Intrinsics, TooFewOrWrongViewsAreRefusedWithTheRemedy) {
  const CameraModel camera(true_camera(Distortion::kRadialTangential));
  std::vector<BoardView> views = views_of(camera, 0.1, 3);
  views.resize(4);
  const auto few = calibrate_intrinsics(views, kBoard, {640, 480}, {});
  ASSERT_FALSE(few);
  EXPECT_NE(few.error().message.find("seen in 4 images"), std::string::npos);
  // The same view again and again says nothing of the lens: an error, or an honest huge sigma.
  const std::vector<BoardView> same(8, views[0]);
  const auto again = calibrate_intrinsics(same, kBoard, {640, 480}, {});
  if (again) {
    EXPECT_GT(again.value().sigma.fx_px, 1.0);
  }
  views.resize(3);
  views.resize(6, {"short", std::vector<cv::Point2f>(10)});
  EXPECT_FALSE(calibrate_intrinsics(views, kBoard, {640, 480}, {}));
}

TEST(Intrinsics, CoverageByHand) {
  // Cells of 80 x 80 pixels: two corners in the first, one in the last.
  const Coverage c =
      coverage_of({{"a", {{10.0F, 10.0F}, {79.0F, 79.0F}, {639.0F, 479.0F}}}}, {640, 480});
  EXPECT_EQ(c.cells.front(), 2);
  EXPECT_EQ(c.cells.back(), 1);
  EXPECT_DOUBLE_EQ(c.share, 2.0 / 48.0);
}

// S1.9 by hand: a camera 1.5 m above the floor, level; the board's middle 2 m ahead, T_cp =
// (0, 1.5, 2) in camera axes: its height is 1.5 m, printed and exact.
TEST(FloorBoard, HeightByHand) {
  EXPECT_DOUBLE_EQ(height_over_plane({0, -1, 0}, {0.3, 1.5, 2.0}), 1.5);
  // Looking down by 30 degrees onto the point 3 m ahead along the axis: 3 sin 30.
  EXPECT_NEAR(height_over_plane({0, -std::cos(kPi / 6), -std::sin(kPi / 6)}, {0, 0, 3}), 1.5,
              1e-12);
}

TEST(FloorBoard, HeightPitchAndRollOfATiltedCamera) {
  const CameraModel camera(true_camera(Distortion::kRadialTangential));
  const Chessboard large{9, 6, 0.08};
  for (const double pitch_deg : {-20.0, -35.0}) {
    for (const double roll_deg : {0.0, 6.0}) {
      // World: x right, y forward, z up; the board lies flat, its corners 1.2 m ahead and on.
      const Eigen::Matrix3d level = (Eigen::Matrix3d() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished();
      const Eigen::Matrix3d camera_from_world =
          Eigen::AngleAxisd(-to_radians(roll_deg), Eigen::Vector3d::UnitZ()).toRotationMatrix() *
          Eigen::AngleAxisd(-to_radians(pitch_deg), Eigen::Vector3d::UnitX()).toRotationMatrix() *
          level;
      std::vector<cv::Point2f> corners;
      for (const cv::Point3f& p : large.points()) {
        // Rows come nearer; seen from above, x right and y towards the camera.
        const Eigen::Vector3d world(p.x - 0.32, 2.2 - p.y, -1.5);
        const auto pixel = camera.pixel(camera_from_world * world);
        ASSERT_TRUE(pixel);
        corners.emplace_back(static_cast<float>(pixel->x()), static_cast<float>(pixel->y()));
      }
      const auto floor = measure_floor(corners, large, camera);
      ASSERT_TRUE(floor);
      EXPECT_NEAR(floor->height_m, 1.5, 0.003);
      EXPECT_NEAR(to_degrees(floor->pitch_rad), pitch_deg, 0.1);
      EXPECT_NEAR(to_degrees(floor->roll_rad), roll_deg, 0.1);
      EXPECT_LT(floor->rms_px, 0.05);
      // As printed the tilt goes into the height.
      EXPECT_LT(floor->printed_height_m, 1.2);
    }
  }
}

TEST(FloorBoard, NothingFromNonsense) {
  const CameraModel camera(true_camera(Distortion::kRadialTangential));
  EXPECT_FALSE(measure_floor({}, kBoard, camera));
  const std::vector<cv::Point2f> one_place(54, cv::Point2f(300.0F, 200.0F));
  EXPECT_FALSE(measure_floor(one_place, kBoard, camera));
}

}  // namespace
}  // namespace vpdr::vision
