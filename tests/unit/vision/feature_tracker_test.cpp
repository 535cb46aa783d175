#include "vision/core/feature_tracker.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace vpdr::vision {
namespace {

CameraParameters parameters() {
  CameraParameters p;
  p.width_px = 640;
  p.height_px = 480;
  p.fx_px = p.fy_px = 450.0;
  p.cx_px = 319.5;
  p.cy_px = 239.5;
  return p;
}

/// Smooth random texture, wider than the image.
cv::Mat texture() {
  cv::Mat noise(700, 900, CV_8UC1);
  cv::RNG rng(5);
  rng.fill(noise, cv::RNG::UNIFORM, 0, 255);
  cv::Mat smooth;
  cv::GaussianBlur(noise, smooth, {0, 0}, 2.5);
  cv::normalize(smooth, smooth, 0, 255, cv::NORM_MINMAX);
  return smooth;
}

/// The texture moved by a fraction of a pixel or more.
cv::Mat view(const cv::Mat& all, double x, double y) {
  cv::Mat out;
  const cv::Mat move = (cv::Mat_<double>(2, 3) << 1, 0, -100.0 + x, 0, 1, -100.0 + y);
  cv::warpAffine(all, out, move, {640, 480}, cv::INTER_CUBIC);
  return out;
}

/// What a camera sees after it has turned: the texture lies at infinity.
cv::Mat turned_view(const cv::Mat& all, const Eigen::Matrix3d& first_from_now) {
  const CameraModel camera(parameters());
  cv::Mat map_x(480, 640, CV_32F), map_y(480, 640, CV_32F), out;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const auto pixel = camera.pixel(first_from_now * camera.ray({u, v}));
      map_x.at<float>(v, u) = static_cast<float>(pixel->x() + 100.0);
      map_y.at<float>(v, u) = static_cast<float>(pixel->y() + 100.0);
    }
  }
  cv::remap(all, out, map_x, map_y, cv::INTER_CUBIC, cv::BORDER_REFLECT);
  return out;
}

TEST(FeatureTracker, FollowsAKnownShift) {
  const cv::Mat all = texture();
  FeatureTracker tracker({}, CameraModel(parameters()));
  const FeatureTracks first = tracker.track(view(all, 0, 0), 0, std::nullopt);
  EXPECT_EQ(first.features.size(), 150U);
  const FeatureTracks second = tracker.track(view(all, 6.3, -3.6), 1, std::nullopt);
  std::size_t matches = 0;
  double squared = 0.0;
  for_each_match(first, second, [&](const TrackedFeature& a, const TrackedFeature& b) {
    ++matches;
    const double off = (b.pixel - a.pixel - Eigen::Vector2d(6.3, -3.6)).norm();
    EXPECT_LT(off, 1.5);
    squared += off * off;
    EXPECT_EQ(b.age, 2U);
  });
  ASSERT_GT(matches, 130U);
  // Evening out the contrast by tiles that stay in place costs a tenth of a pixel.
  EXPECT_LT(std::sqrt(squared / static_cast<double>(matches)), 0.2);
}

TEST(FeatureTracker, IdsRiseAndAreNeverUsedAgain) {
  const cv::Mat all = texture();
  FeatureTracker tracker({}, CameraModel(parameters()));
  FeatureId highest = 0;
  for (int i = 0; i < 6; ++i) {
    if (i == 3) tracker.reset();
    const FeatureTracks& tracks = tracker.track(view(all, 15.0 * i, 0), i, std::nullopt);
    for (std::size_t k = 1; k < tracks.features.size(); ++k) {
      EXPECT_LT(tracks.features[k - 1].id, tracks.features[k].id);
    }
    if (i == 3) {
      EXPECT_GT(tracks.features.front().id, highest);
    }
    highest = tracks.features.back().id;
  }
}

TEST(FeatureTracker, TheGyroscopesTurnFindsPointsThatJumped) {
  const cv::Mat all = texture();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.16, Eigen::Vector3d::UnitY()).toRotationMatrix();  // 72 px
  const cv::Mat before = turned_view(all, Eigen::Matrix3d::Identity());
  const cv::Mat after = turned_view(all, turn);
  const auto right = [&](const std::optional<Eigen::Matrix3d>& prediction) {
    FeatureTracker tracker({}, CameraModel(parameters()));
    const FeatureTracks first = tracker.track(before, 0, std::nullopt);
    int count = 0;
    for_each_match(first, tracker.track(after, 1, prediction),
                   [&](const TrackedFeature& a, const TrackedFeature& b) {
                     count += (turn * b.ray - a.ray).norm() < 2e-3 ? 1 : 0;
                   });
    return count;
  };
  const int with = right(turn.transpose());
  const int without = right(std::nullopt);
  EXPECT_GT(with, 80);
  EXPECT_GT(with, without);
}

TEST(FeatureTracker, SpreadsPointsAndKeepsThemApart) {
  FeatureTracker tracker({}, CameraModel(parameters()));
  const cv::Mat all = texture();
  FeatureTracks tracks;
  for (int i = 0; i < 5; ++i) tracks = tracker.track(view(all, 4.0 * i, 2.0 * i), i, std::nullopt);
  int quarters[4] = {};
  for (std::size_t i = 0; i < tracks.features.size(); ++i) {
    const auto& p = tracks.features[i].pixel;
    ++quarters[(p.x() > 320 ? 1 : 0) + (p.y() > 240 ? 2 : 0)];
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT((p - tracks.features[k].pixel).norm(), 4.9);
  }
  for (const int n : quarters) EXPECT_GT(n, 20);
}

TEST(FeatureTracker, FindsNothingInABlankImage) {
  FeatureTracker tracker({}, CameraModel(parameters()));
  const cv::Mat grey(480, 640, CV_8UC1, cv::Scalar(128));
  EXPECT_TRUE(tracker.track(grey, 0, std::nullopt).features.empty());
  EXPECT_TRUE(tracker.track(grey, 1, std::nullopt).features.empty());
  EXPECT_FALSE(tracker.track(view(texture(), 0, 0), 2, std::nullopt).features.empty());
}

}  // namespace
}  // namespace vpdr::vision
