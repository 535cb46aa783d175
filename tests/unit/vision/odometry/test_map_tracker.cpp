#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "vision/core/odometry/map_tracker.hpp"

namespace vpdr::vision {
namespace {

using Eigen::Vector3d;

constexpr double kRaySigma = 1e-4;
constexpr double kFrame_s = 0.1;

/// Points on two walls and ahead, at many distances: map axes are the first camera's.
std::vector<Vector3d> points() {
  std::vector<Vector3d> out;
  for (int i = 0; i < 60; ++i) {
    const double z = 3.0 + 0.1 * i;
    out.emplace_back(i % 2 ? 1.2 : -1.2, 0.3 * (i % 7 - 3), z);
  }
  return out;
}

/// Sideways half a metre a second, turning 0.1 rad a second about the vertical.
CameraPose pose_at(int frame) {
  const double t = kFrame_s * frame;
  return {{0.5 * t, 0.0, 0.0}, exp_rotation({0.0, 0.1 * t, 0.0})};
}

FeatureTracks frame_of(const std::vector<Vector3d>& world, int frame) {
  const CameraPose pose = pose_at(frame);
  FeatureTracks tracks;
  tracks.stamp_ns = to_ns(kFrame_s * frame);
  for (const Vector3d& p : world) {
    TrackedFeature f;
    f.id = tracks.features.size() + 1;
    f.ray = (pose.map_from_camera.conjugate() * (p - pose.position)).normalized();
    tracks.features.push_back(f);
  }
  return tracks;
}

FeatureTracks frame_at(int frame) { return frame_of(points(), frame); }

/// Has seen so many frames.
MapTracker after_frames(int count) {
  MapTracker tracker({});
  for (int k = 0; k < count; ++k) tracker.process(frame_at(k), std::nullopt, kRaySigma, 1.0);
  return tracker;
}

double worst_rad(const std::vector<Vector3d>& expected, const FeatureTracks& seen) {
  double worst = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    worst = std::max(worst, (expected[i].normalized() - seen.features[i].ray).norm());
  }
  return worst;
}

double angle_between(const Eigen::Matrix3d& earlier_from_later) {
  return Eigen::AngleAxisd(earlier_from_later).angle();
}

TEST(MapTracker, ExpectsThePointsWhereASteadyWayTakesThem) {
  const int frame = 12;
  MapTracker tracker = after_frames(frame);
  ASSERT_EQ(tracker.state(), MapState::kTracking);
  std::vector<Vector3d> expected;
  tracker.expect(frame_at(frame - 1), to_ns(kFrame_s * frame), std::nullopt, expected);
  ASSERT_EQ(expected.size(), points().size());
  EXPECT_LT(worst_rad(expected, frame_at(frame)), 2e-3);
  // Where they were is 0.01 rad of turn and up to 0.05 m in 3 m off.
  std::vector<Vector3d> before;
  for (const TrackedFeature& f : frame_at(frame - 1).features) before.push_back(f.ray);
  EXPECT_GT(worst_rad(before, frame_at(frame)), 0.01);
}

TEST(MapTracker, ANewPointIsExpectedAtTheUsualDistance) {
  const int frame = 12;
  MapTracker tracker = after_frames(frame);
  FeatureTracks before = frame_at(frame - 1);
  for (TrackedFeature& f : before.features) f.id += 1000;
  std::vector<Vector3d> expected;
  tracker.expect(before, to_ns(kFrame_s * frame), std::nullopt, expected);
  ASSERT_EQ(expected.size(), points().size());
  // At 6 m in place of 3: 0.05 m seen from there is 0.008 rad less.
  EXPECT_LT(worst_rad(expected, frame_at(frame)), 0.012);
}

TEST(MapTracker, AMapThatIsContradictedIsGivenUpAndTheFramesTellTheTurn) {
  const int frame = 12;
  MapTracker tracker = after_frames(frame);
  ASSERT_EQ(tracker.state(), MapState::kTracking);
  // Every point is suddenly another one, as after a wrong start, and the camera goes on as before.
  std::vector<Vector3d> other = points();
  for (std::size_t i = 0; i < other.size(); ++i) {
    other[i].y() += 1.2 * std::sin(7.0 * static_cast<double>(i));
  }
  const MapStep step = tracker.process(frame_of(other, frame), std::nullopt, kRaySigma, 1.0);
  EXPECT_EQ(step.state, MapState::kStarting);
  ASSERT_TRUE(step.two_frames);
  const MapStep next = tracker.process(frame_of(other, frame + 1), std::nullopt, kRaySigma, 1.0);
  ASSERT_TRUE(next.two_frames);
  EXPECT_NEAR(angle_between(next.two_frames->earlier_from_later), 0.1 * kFrame_s, 2e-3);
}

TEST(MapTracker, WithoutAMapTheTurnIsAllThatIsExpected) {
  MapTracker tracker({});
  tracker.process(frame_at(0), std::nullopt, kRaySigma, std::nullopt);
  std::vector<Vector3d> expected;
  tracker.expect(frame_at(0), to_ns(kFrame_s), std::nullopt, expected);
  EXPECT_TRUE(expected.empty());
  const RotationPrior turn{exp_rotation({0.0, 0.01, 0.0}).toRotationMatrix(), 1e-3};
  tracker.expect(frame_at(0), to_ns(kFrame_s), turn, expected);
  ASSERT_EQ(expected.size(), points().size());
  EXPECT_LT(
      (expected[0] - turn.earlier_from_later.transpose() * frame_at(0).features[0].ray).norm(),
      1e-12);
}

}  // namespace
}  // namespace vpdr::vision
