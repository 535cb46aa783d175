#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <ctime>
#include <iostream>
#include <optional>
#include <stdexcept>

#include "core/rotation.hpp"
#include "simulation/render/scene.hpp"
#include "simulation/render/scene_renderer.hpp"
#include "simulation/walk_camera.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSkirtingM = 0.11;

FloorPlan corridor() { return FloorPlan({{{-1.0, -1.2}, {40.0, 1.2}}}); }

RenderOptions clean() {
  RenderOptions options;
  options.sensor = ImageSensorOptions::quiet();
  return options;
}

/// Camera in the corridor's middle, turned from the corridor's direction.
Eigen::Isometry3d pose_at(double x, double yaw, double pitch, double roll) {
  Eigen::Isometry3d body = Eigen::Isometry3d::Identity();
  body.linear() = from_euler({roll, pitch, yaw}).toRotationMatrix();
  body.translation() = Vector3d(x, 0.1, 1.6);
  return body * Camera::looking_ahead({0.0, 0.0, 0.0}, 0.1);
}

double brightness_at(const cv::Mat& image, double u, double v) {
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const double a = u - i, b = v - j;
  return (1 - b) * ((1 - a) * image.at<std::uint8_t>(j, i) + a * image.at<std::uint8_t>(j, i + 1)) +
         b * ((1 - a) * image.at<std::uint8_t>(j + 1, i) +
              a * image.at<std::uint8_t>(j + 1, i + 1));
}

/// Row near `v` where brightness, going down column `u`, falls through half-way from what is 5
/// pixels above to what is 5 below; none where there is no clear edge.
std::optional<double> edge_row(const cv::Mat& image, double u, double v) {
  const double above = brightness_at(image, u, v - 5.0), below = brightness_at(image, u, v + 5.0);
  if (above - below < 40.0) return std::nullopt;
  const double half = 0.5 * (above + below);
  for (double row = v - 5.0; row < v + 5.0; row += 0.05) {
    if (brightness_at(image, u, row) < half) return row;
  }
  return std::nullopt;
}

struct EdgePoint {
  Vector2d seen;      ///< pixel
  Vector2d expected;  ///< pixel
};

/// The upper edge of the skirting along one wall, where nothing hangs in front of it.
std::vector<EdgePoint> skirting_edge(const SceneRenderer& renderer, const cv::Mat& image,
                                     const Eigen::Isometry3d& world_from_camera, double side) {
  std::vector<EdgePoint> points;
  const auto& walls = renderer.scene().plan().walls();
  for (std::size_t w = 0; w < walls.size(); ++w) {
    if (walls[w].normal.y() * side > -0.5) continue;
    for (double x = 0.0; x < 12.0; x += 0.05) {
      const auto along = static_cast<float>(std::abs(x - walls[w].start_m.x()));
      bool covered = false;
      for (const WallObject& object : renderer.scene().faces()[w].rows[0].objects) {
        covered =
            covered || (along > object.along.low - 0.15F && along < object.along.high + 0.15F);
      }
      const Vector3d place(x, side * 1.2, kSkirtingM);
      const auto pixel = renderer.camera().project(world_from_camera.inverse() * place);
      if (covered || !pixel || pixel->x() < 1 || pixel->x() > renderer.camera().width - 3 ||
          pixel->y() < 8 || pixel->y() > renderer.camera().height - 8) {
        continue;
      }
      const auto row = edge_row(image, pixel->x(), pixel->y());
      if (row) points.push_back({{pixel->x(), *row}, *pixel});
    }
  }
  return points;
}

Vector2d normalised(const Camera& camera, const Vector2d& pixel) {
  return camera.ray(pixel).hnormalized();
}

/// Line through points in undistorted normalised coordinates: normal and offset.
Vector3d fit_line(const Camera& camera, const std::vector<EdgePoint>& points) {
  Vector2d mean = Vector2d::Zero();
  for (const EdgePoint& p : points) {
    mean += normalised(camera, p.seen) / static_cast<double>(points.size());
  }
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const EdgePoint& p : points) {
    const Vector2d d = normalised(camera, p.seen) - mean;
    scatter += d * d.transpose();
  }
  const double angle = 0.5 * std::atan2(2.0 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
  const Vector2d normal(-std::sin(angle), std::cos(angle));
  return {normal.x(), normal.y(), -normal.dot(mean)};
}

struct Turn {
  double yaw, pitch, roll;
};

class KnownEdges : public testing::TestWithParam<Turn> {};

TEST_P(KnownEdges, AppearWhereTheyProjectAndMeetInTheVanishingPoint) {
  const SceneRenderer renderer(corridor(), Camera{}, 3, clean());
  const Turn turn = GetParam();
  const Eigen::Isometry3d pose = pose_at(1.0, turn.yaw, turn.pitch, turn.roll);
  const cv::Mat image = renderer.render(pose);
  std::vector<Vector3d> lines;
  for (const double side : {1.0, -1.0}) {
    const auto points = skirting_edge(renderer, image, pose, side);
    ASSERT_GT(points.size(), 10u);
    for (const EdgePoint& p : points) EXPECT_NEAR(p.seen.y(), p.expected.y(), 1.0);
    lines.push_back(fit_line(renderer.camera(), points));
  }
  const Vector3d seen = lines[0].cross(lines[1]);
  const Vector3d corridor_in_camera = pose.linear().transpose() * Vector3d::UnitX();
  // 0.2 degrees: half a pixel's edge over the length that is seen.
  EXPECT_NEAR(seen.x() / seen.z(), corridor_in_camera.x() / corridor_in_camera.z(), 0.0035);
  EXPECT_NEAR(seen.y() / seen.z(), corridor_in_camera.y() / corridor_in_camera.z(), 0.0035);
}

INSTANTIATE_TEST_SUITE_P(Turns, KnownEdges,
                         testing::Values(Turn{0.0, 0.0, 0.0}, Turn{0.12, 0.0, 0.0},
                                         Turn{-0.1, 0.05, 0.0}, Turn{0.0, -0.05, 0.04},
                                         Turn{0.05, 0.08, -0.05}));

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && std::memcmp(a.data, b.data, a.total()) == 0;
}

double mean_difference(const cv::Mat& a, const cv::Mat& b, const cv::Rect& area) {
  double sum = 0.0;
  for (int j = area.y; j < area.y + area.height; ++j) {
    for (int i = area.x; i < area.x + area.width; ++i) {
      sum += std::abs(a.at<std::uint8_t>(j, i) - b.at<std::uint8_t>(j, i));
    }
  }
  return sum / area.area();
}

Camera small_camera() {
  Camera camera;
  camera.width = 160;
  camera.height = 120;
  camera.fx = camera.fy = 115.0;
  camera.cx = 79.5;
  camera.cy = 59.5;
  return camera;
}

TEST(SceneRenderer, ThreadsDoNotChangeThePicture) {
  const Camera camera = small_camera();
  RenderOptions options;
  const SceneRenderer one(corridor(), camera, 3, options);
  options.threads = 3;
  const SceneRenderer three(corridor(), camera, 3, options);
  const auto pose = pose_at(2.0, 0.3, 0.0, 0.0);
  EXPECT_TRUE(same(one.render(pose, 5), three.render(pose, 5)));
}

TEST(SceneRenderer, NoiseDiffersFromPictureToPictureByItsSize) {
  const SceneRenderer renderer(corridor(), small_camera(), 3);
  const SceneRenderer quiet(corridor(), small_camera(), 3, clean());
  const auto pose = pose_at(2.0, 0.3, 0.0, 0.0);
  const cv::Mat a = renderer.render(pose, 1), b = renderer.render(pose, 2);
  EXPECT_TRUE(same(a, renderer.render(pose, 1)));
  EXPECT_FALSE(same(a, b));
  const double noise = mean_difference(a, quiet.render(pose), {0, 0, 160, 120});
  EXPECT_GT(noise, 0.8);
  EXPECT_LT(noise, 4.0);
}

TEST(SceneRenderer, SeedsLookDifferent) {
  const SceneRenderer a(corridor(), small_camera(), 3, clean());
  const SceneRenderer b(corridor(), small_camera(), 4, clean());
  const auto pose = pose_at(2.0, 0.3, 0.0, 0.0);
  EXPECT_GT(mean_difference(a.render(pose), b.render(pose), {0, 0, 160, 120}), 4.0);
}

TEST(SceneRenderer, FarPartsDoNotShimmer) {
  const SceneRenderer renderer(corridor(), Camera{}, 3, clean());
  const cv::Mat before = renderer.render(pose_at(1.0, 0.0, 0.1, 0.0));
  const cv::Mat after = renderer.render(pose_at(1.02, 0.0, 0.1, 0.0));
  // With the head up by 0.1 rad the vanishing point is in the middle: 15 m away and more.
  EXPECT_LT(mean_difference(before, after, {280, 200, 80, 80}), 1.0);
}

TEST(SceneRenderer, FillsThePictureWithLightAndContrast) {
  const SceneRenderer renderer(corridor(), small_camera(), 3);
  for (double yaw = 0.0; yaw < 6.2; yaw += 0.5) {
    const cv::Mat image = renderer.render(pose_at(20.0, yaw, 0.0, 0.0));
    double sum = 0.0, squares = 0.0;
    for (int j = 0; j < image.rows; ++j) {
      for (int i = 0; i < image.cols; ++i) {
        const double grey = image.at<std::uint8_t>(j, i);
        sum += grey / static_cast<double>(image.total());
        squares += grey * grey / static_cast<double>(image.total());
      }
    }
    EXPECT_GT(sum, 60.0);
    EXPECT_LT(sum, 220.0);
    EXPECT_GT(std::sqrt(squares - sum * sum), 8.0);
  }
}

TEST(SceneRenderer, RefusesAnEyeInsideAWall) {
  const SceneRenderer renderer(corridor(), small_camera(), 3);
  Eigen::Isometry3d pose = pose_at(2.0, 0.0, 0.0, 0.0);
  pose.translation().y() = 3.0;
  EXPECT_THROW(static_cast<void>(renderer.render(pose)), std::domain_error);
  pose.translation() = Vector3d(2.0, 0.0, 2.8);
  EXPECT_THROW(static_cast<void>(renderer.render(pose)), std::domain_error);
}

TEST(WalkCamera, ShowsEveryFrameOfAWalk) {
  WalkOptions options;
  options.seed = 6;
  options.duration_s = 20.0;
  options.camera = small_camera();
  options.camera_rate_hz = 2.0;
  const WalkCamera camera(simulate_walk(options)), again(simulate_walk(options));
  ASSERT_EQ(camera.count(), 40u);
  for (std::size_t k = 0; k < camera.count(); ++k) {
    const cv::Mat image = camera.image(k);
    EXPECT_EQ(image.type(), CV_8UC1);
    EXPECT_TRUE(same(image, again.image(k)));
  }
  EXPECT_EQ(camera.stamp(2) - camera.stamp(0), kNsPerSecond);
  EXPECT_THROW(static_cast<void>(camera.image(40)), std::out_of_range);
}

TEST(SceneRenderer, FramesPerSecondOnOneCore) {
  WalkOptions options;
  options.duration_s = 40.0;
  const WalkCamera camera(simulate_walk(options));
  const std::clock_t start = std::clock();  // processor time: other programs do not count
  int frames = 0;
  for (std::size_t k = 0; k < camera.count(); k += 40) {
    ASSERT_EQ(camera.image(k).total(), 640u * 480u);
    ++frames;
  }
  const double took_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const double rate = frames / took_s;
  std::cout << "renders " << rate << " frames of 640x480 a second on one core\n";
  EXPECT_GT(rate, 0.2);
}

}  // namespace
}  // namespace vpdr::simulation
