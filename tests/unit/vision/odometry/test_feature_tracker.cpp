#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "vision/core/odometry/feature_tracker.hpp"

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
cv::Mat texture(double grain_px = 2.5) {
  cv::Mat noise(700, 900, CV_8UC1);
  cv::RNG rng(5);
  rng.fill(noise, cv::RNG::UNIFORM, 0, 255);
  cv::Mat smooth;
  cv::GaussianBlur(noise, smooth, {0, 0}, grain_px);
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

/// RMS error of the points' way, pixels, when the whole image shifts by a fraction of one.
double shift_error_px(const FeatureTrackerConfig& config) {
  const cv::Mat all = texture();
  FeatureTracker tracker(config, CameraModel(parameters()));
  const FeatureTracks first = tracker.track(view(all, 0, 0), 0, {});
  EXPECT_EQ(first.features.size(), 150U);
  const FeatureTracks second = tracker.track(view(all, 6.3, -3.6), 1, {});
  std::size_t matches = 0;
  double squared = 0.0;
  for_each_match(first, second, [&](const TrackedFeature& a, const TrackedFeature& b) {
    ++matches;
    const double off = (b.pixel - a.pixel - Eigen::Vector2d(6.3, -3.6)).norm();
    EXPECT_LT(off, 1.5);
    squared += off * off;
    EXPECT_EQ(b.age, 2U);
  });
  EXPECT_GT(matches, 130U);
  return std::sqrt(squared / static_cast<double>(matches));
}

TEST(FeatureTracker, FollowsAKnownShift) {
  // In so fine a grain: 0.23 px with a window of 17 px, 0.19 px with one of 21 px.
  EXPECT_LT(shift_error_px({}), 0.25);
  FeatureTrackerConfig wide;
  wide.flow_window_px = 21;
  EXPECT_LT(shift_error_px(wide), 0.2);
}

TEST(FeatureTracker, IdsRiseAndAreNeverUsedAgain) {
  const cv::Mat all = texture();
  FeatureTracker tracker({}, CameraModel(parameters()));
  FeatureId highest = 0;
  for (int i = 0; i < 6; ++i) {
    if (i == 3) tracker.reset();
    const FeatureTracks& tracks = tracker.track(view(all, 15.0 * i, 0), i, {});
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
  const auto right = [&](bool is_known) {
    FeatureTracker tracker({}, CameraModel(parameters()));
    const FeatureTracks first = tracker.track(before, 0, {});
    std::vector<Eigen::Vector3d> expected;
    for (const TrackedFeature& f : first.features) {
      if (is_known) expected.emplace_back(turn.transpose() * f.ray);
    }
    int count = 0;
    for_each_match(first, tracker.track(after, 1, expected),
                   [&](const TrackedFeature& a, const TrackedFeature& b) {
                     count += (turn * b.ray - a.ray).norm() < 2e-3 ? 1 : 0;
                   });
    return count;
  };
  const int with = right(true);
  const int without = right(false);
  EXPECT_GT(with, 80);
  EXPECT_GT(with, without);
}

TEST(FeatureTracker, AJumpAfterCalmFramesIsSoughtOnAllLevels) {
  constexpr double kJump_px = 40.0;
  const cv::Mat all = texture(8.0);
  FeatureTracker tracker({}, CameraModel(parameters()));
  for (int i = 0; i < 4; ++i) tracker.track(view(all, 0.5 * i, 0), i, {});
  const FeatureTracks calm = tracker.tracks();
  int followed = 0;
  for_each_match(calm, tracker.track(view(all, 1.5 + kJump_px, 0), 4, {}),
                 [&](const TrackedFeature& a, const TrackedFeature& b) {
                   followed +=
                       (b.pixel - a.pixel - Eigen::Vector2d(kJump_px, 0)).norm() < 2.0 ? 1 : 0;
                 });
  EXPECT_GT(followed, 50);  // a second look: on the calm frames' levels alone it is half of that
}

TEST(FeatureTracker, SpreadsPointsAndKeepsThemApart) {
  FeatureTracker tracker({}, CameraModel(parameters()));
  const cv::Mat all = texture();
  FeatureTracks tracks;
  for (int i = 0; i < 5; ++i) tracks = tracker.track(view(all, 4.0 * i, 2.0 * i), i, {});
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
  EXPECT_TRUE(tracker.track(grey, 0, {}).features.empty());
  EXPECT_TRUE(tracker.track(grey, 1, {}).features.empty());
  EXPECT_FALSE(tracker.track(view(texture(), 0, 0), 2, {}).features.empty());
}

}  // namespace
}  // namespace vpdr::vision
