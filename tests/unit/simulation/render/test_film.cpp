#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "simulation/render/film.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector3d;

constexpr TimestampNs kFrameNs = 100'000'000;

bool same(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && std::memcmp(a.data, b.data, a.total()) == 0;
}

double mean(const cv::Mat& image) {
  double sum = 0.0;
  for (int j = 0; j < image.rows; ++j) {
    for (int i = 0; i < image.cols; ++i) sum += image.at<std::uint8_t>(j, i);
  }
  return sum / static_cast<double>(image.total());
}

/// Mean difference between neighbours in a row: how sharp upright edges are.
double sharpness(const cv::Mat& image) {
  double sum = 0.0;
  for (int j = 0; j < image.rows; ++j) {
    for (int i = 1; i < image.cols; ++i) {
      sum += std::abs(image.at<std::uint8_t>(j, i) - image.at<std::uint8_t>(j, i - 1));
    }
  }
  return sum / static_cast<double>(image.total());
}

/// Three seconds in a corridor along x, turning at 1 rad/s.
Shot turning_shot() {
  Shot shot{.plan = FloorPlan({{{-1.0, -1.2}, {30.0, 1.2}}}),
            .camera = {},
            .seed = 5,
            .frames = {},
            .world_from_camera = {}};
  shot.camera.width = 160;
  shot.camera.height = 120;
  shot.camera.fx = shot.camera.fy = 115.0;
  shot.camera.cx = 79.5;
  shot.camera.cy = 59.5;
  for (int k = 0; k < 30; ++k) shot.frames.push_back(k * kFrameNs);
  shot.world_from_camera = [](TimestampNs stamp) {
    Eigen::Isometry3d body = Eigen::Isometry3d::Identity();
    body.linear() = from_euler({0.0, 0.0, to_seconds(stamp) - 1.5}).toRotationMatrix();
    body.translation() = Vector3d(2.0, 0.0, 1.6);
    return body * Camera::looking_ahead({0.0, 0.0, 0.0}, 0.0);
  };
  return shot;
}

FilmOptions quiet() {
  FilmOptions options;
  options.render.sensor = ImageSensorOptions::quiet();
  return options;
}

TEST(Film, TheLongerTheExposureTheMoreATurnBlurs) {
  FilmOptions options = quiet();
  const double sharp = sharpness(Film(turning_shot(), options).image(15));
  options.exposure_s = 0.04;  // 4.6 pixels
  const double little = sharpness(Film(turning_shot(), options).image(15));
  options.exposure_s = 0.12;
  const double much = sharpness(Film(turning_shot(), options).image(15));
  EXPECT_LT(little, 0.8 * sharp);
  EXPECT_LT(much, 0.8 * little);
}

TEST(Film, TheMiddleOfTheExposureIsTheStamp) {
  // A blurred picture is nearer to the sharp one of its stamp than to those of 20 ms before or
  // after.
  FilmOptions options = quiet();
  Shot shot = turning_shot();
  shot.frames = {1'480'000'000, 1'500'000'000, 1'520'000'000};
  const Film sharp(shot, options);
  options.exposure_s = 0.03;
  const cv::Mat blurred = Film(shot, options).image(1);
  const auto off = [&](std::size_t k) {
    const cv::Mat other = sharp.image(k);
    double sum = 0.0;
    for (int j = 0; j < other.rows; ++j) {
      for (int i = 0; i < other.cols; ++i) {
        sum += std::abs(blurred.at<std::uint8_t>(j, i) - other.at<std::uint8_t>(j, i));
      }
    }
    return sum;
  };
  EXPECT_LT(off(1), 0.7 * off(0));
  EXPECT_LT(off(1), 0.7 * off(2));
}

TEST(Film, LampsGoOutAndComeBack) {
  FilmOptions options = quiet();
  options.dark = {{1.0, 2.0}};
  const Film film(turning_shot(), options);
  EXPECT_GT(mean(film.image(9)), 60.0);
  EXPECT_LT(mean(film.image(10)), 8.0);
  EXPECT_LT(mean(film.image(19)), 8.0);
  EXPECT_GT(mean(film.image(20)), 60.0);
}

TEST(Film, ABlankWallShowsNothing) {
  FilmOptions options = quiet();
  options.blank = {{1.0, 2.0}};
  const Film film(turning_shot(), options);
  EXPECT_GT(sharpness(film.image(9)), 1.0);
  EXPECT_LT(sharpness(film.image(10)), 0.5);
  EXPECT_GT(mean(film.image(10)), 60.0);
  EXPECT_GT(sharpness(film.image(20)), 1.0);
}

TEST(Film, ExposureSwingsByItsSize) {
  FilmOptions options = quiet();
  options.exposure_swing_ev = 0.5;
  const Film swinging(turning_shot(), options);
  const Film steady(turning_shot(), quiet());
  double least = 1e9, most = 0.0;
  for (std::size_t k = 0; k < 30; k += 3) {
    const double ratio = mean(swinging.image(k)) / mean(steady.image(k));
    least = std::min(least, ratio);
    most = std::max(most, ratio);
  }
  EXPECT_GT(most / least, 1.05);
  EXPECT_GT(least, 0.3);
  EXPECT_LT(most, 3.0);
}

TEST(Film, PeopleComeInFrontOfTheWalls) {
  FilmOptions options = quiet();
  options.passers_by_per_min = 60.0;
  const Film crowded(turning_shot(), options), empty(turning_shot(), quiet());
  int nearer = 0;
  for (std::size_t k = 0; k < 30; k += 2) {
    const cv::Mat with = crowded.depth(k), without = empty.depth(k);
    for (int j = 0; j < with.rows; ++j) {
      for (int i = 0; i < with.cols; ++i) {
        ASSERT_LE(with.at<float>(j, i), without.at<float>(j, i) + 1e-4F);
        nearer += with.at<float>(j, i) < 0.9F * without.at<float>(j, i) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(nearer, 2000);
}

TEST(Film, TheSeedDecidesEveryEffect) {
  FilmOptions options;
  options.exposure_s = 0.02;
  options.exposure_swing_ev = 0.3;
  options.passers_by_per_min = 60.0;
  Shot shot = turning_shot();
  const Film one(shot, options), again(shot, options);
  shot.seed = 6;
  const Film other(shot, options);
  EXPECT_TRUE(same(one.image(12), again.image(12)));
  EXPECT_FALSE(same(one.image(12), other.image(12)));
}

TEST(Film, TruthByHand) {
  // At 1.5 s the camera looks along the corridor, level: its x is south, its y down, its z east.
  const Film film(turning_shot(), quiet());
  const FrameTruth truth = film.truth(15);
  EXPECT_EQ(truth.stamp_ns, 1'500'000'000);
  EXPECT_TRUE(truth.building[0].isApprox(Vector3d(0.0, 0.0, 1.0), 1e-9));
  EXPECT_TRUE(truth.building[1].isApprox(Vector3d(-1.0, 0.0, 0.0), 1e-9));
  EXPECT_TRUE(truth.building[2].isApprox(Vector3d(0.0, -1.0, 0.0), 1e-9));
  // The end wall, 28 m ahead, shows in the middle.
  const cv::Mat depth = film.depth(15);
  EXPECT_NEAR(depth.at<float>(59, 79), 28.0, 1e-3);
  // The floor is 1.6 m below: 40 pixels under the middle, where the lens hardly bends.
  Camera straight = film.shot().camera;
  const Vector3d ray = straight.ray({79.5, 99.0});
  EXPECT_NEAR(film.depth(15).at<float>(99, 79), 1.6 * ray.z() / ray.y(), 0.02);
}

TEST(Film, RefusesWhatMakesNoSense) {
  FilmOptions options;
  options.exposure_s = -0.1;
  EXPECT_THROW(Film(turning_shot(), options), ConfigurationFault);
  options = {};
  options.dark = {{2.0, 1.0}};
  EXPECT_THROW(Film(turning_shot(), options), ConfigurationFault);
  options = {};
  options.render.sensor.vignetting = 1.5;
  EXPECT_THROW(Film(turning_shot(), options), ConfigurationFault);
}

}  // namespace
}  // namespace vpdr::simulation
