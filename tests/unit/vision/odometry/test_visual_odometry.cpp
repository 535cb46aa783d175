// Visual odometry as a whole, on rendered corridors with known motion.
#include <gtest/gtest.h>

#include "core/rotation.hpp"
#include "simulation/render/scene_renderer.hpp"
#include "vision/core/odometry/visual_odometry.hpp"
#include "vision/source/simulated_source.hpp"

namespace vpdr::vision {
namespace {

using Eigen::Vector3d;

constexpr double kHeightM = 1.5;
constexpr double kRate = 20.0;

TimestampNs stamp_of(int frame) { return kNsPerSecond + to_ns(frame / kRate); }

/// The body stands, walks at 1.2 m/s with a slow turn of the head, and stands again.
Eigen::Isometry3d body_at(int frame) {
  const double t = std::clamp(frame / kRate - 1.0, 0.0, 3.0);
  Eigen::Isometry3d body = Eigen::Isometry3d::Identity();
  body.linear() = from_euler({0.0, 0.0, 0.15 * std::sin(1.2 * t)}).toRotationMatrix();
  body.translation() = Vector3d(1.0 + 1.2 * t, 0.1 * t, kHeightM);
  return body;
}

AttitudePrior attitude_at(int frame) {
  AttitudePrior prior;
  prior.world_from_body = Eigen::Quaterniond(body_at(frame).linear());
  prior.inclination_sigma_rad = 0.01;
  prior.turn = GyroTurn{0.0, 0, Eigen::Quaterniond(body_at(frame).linear())};
  return prior;
}

class OdometryOfACorridor : public testing::Test {
 protected:
  OdometryOfACorridor()
      : renderer_(simulation::FloorPlan({{{-1.0, -1.2}, {20.0, 1.2}}}), lens_, 3),
        camera_(make_camera(lens_)) {}

  cv::Mat image(int frame) const {
    return renderer_.render(body_at(frame) * lens_.body_from_camera,
                            static_cast<std::uint64_t>(frame));
  }
  static OdometryConfig config() {
    OdometryConfig c;
    c.scale.camera_height_m = kHeightM + 0.02;
    return c;
  }
  OdometryOutput feed(VisualOdometry& odometry, int frame, bool with_gyro = true) const {
    OdometryInput input{image(frame), stamp_of(frame), std::nullopt, std::nullopt};
    if (with_gyro) input.attitude = attitude_at(frame);
    return odometry.process(input);
  }

  simulation::Camera lens_;
  simulation::SceneRenderer renderer_;
  CameraModel camera_;
};

TEST_F(OdometryOfACorridor, GivesMetricMotionAndKnowsStandingFromWalking) {
  VisualOdometry odometry(config(), {}, camera_);
  int still_wrong = 0, metric = 0;
  double worst_turn = 0.0, length = 0.0, true_length = 0.0;
  for (int i = 0; i < 100; ++i) {
    const OdometryOutput out = feed(odometry, i);
    const bool stands = i <= 20 || i > 80;
    if (i > 8 && i < 19) {
      EXPECT_EQ(out.outcome, MotionOutcome::kStill) << i;
    }
    still_wrong += !stands && out.outcome == MotionOutcome::kStill ? 1 : 0;
    if (!out.motion) continue;
    const Eigen::Isometry3d truth = body_at(i - 1).inverse() * body_at(i);
    worst_turn = std::max(worst_turn,
                          out.motion->rotation.angularDistance(Eigen::Quaterniond(truth.linear())));
    if (out.outcome != MotionOutcome::kMoved || !out.motion->metric || stands) continue;
    ++metric;
    length += out.motion->translation_m.norm();
    true_length += truth.translation().norm();
    EXPECT_GT(out.motion->translation_m.normalized().dot(truth.translation().normalized()), 0.95);
  }
  EXPECT_LE(still_wrong, 2);
  EXPECT_GT(metric, 30);
  EXPECT_NEAR(length / true_length, 1.0, 0.06);
  EXPECT_LT(worst_turn, to_radians(0.3));
  EXPECT_GT(odometry.scale().floor_looks(), 3U);
}

TEST_F(OdometryOfACorridor, WithoutGyroscopeOrScaleTheMotionIsNotMetric) {
  VisualOdometry odometry({}, {}, camera_);
  bool moved = false;
  for (int i = 15; i < 60; ++i) {
    const OdometryOutput out = feed(odometry, i, false);
    moved = moved || out.outcome == MotionOutcome::kMoved;
    if (!out.motion || out.outcome == MotionOutcome::kStill) continue;
    EXPECT_FALSE(out.motion->metric);
    EXPECT_FALSE(out.odometry);
  }
  EXPECT_TRUE(moved);
}

TEST_F(OdometryOfACorridor, TheCamerasOwnHeightGivesTheScaleWhereTheSettingsNameNone) {
  CameraParameters p = camera_.parameters();
  p.height_m = config().scale.camera_height_m;
  VisualOdometry own({}, {}, CameraModel(p)), told(config(), {}, camera_);
  p.height_m *= 2.0;  // the settings count where both say something
  VisualOdometry both(config(), {}, CameraModel(p));
  for (int i = 15; i < 50; ++i) {
    const OdometryOutput a = feed(own, i), b = feed(told, i), c = feed(both, i);
    ASSERT_EQ(a.motion.has_value(), b.motion.has_value());
    if (!a.motion) continue;
    EXPECT_EQ(a.motion->metric, b.motion->metric);
    EXPECT_EQ(a.motion->translation_m, b.motion->translation_m);
    EXPECT_EQ(c.motion->translation_m, b.motion->translation_m);
  }
  EXPECT_GT(own.scale().floor_looks(), 0U);
}

TEST_F(OdometryOfACorridor, BadFramesAreNamedAndBridged) {
  VisualOdometry odometry(config(), {}, camera_);
  int frame = 20;
  for (; frame < 45; ++frame) feed(odometry, frame);
  const cv::Mat good = image(frame);
  const auto outcome_of = [&](const cv::Mat& bad) {
    return odometry.process({bad, stamp_of(frame++), attitude_at(frame), std::nullopt});
  };
  EXPECT_EQ(outcome_of({}).frame, FrameOutcome::kEmpty);
  EXPECT_EQ(outcome_of(cv::Mat(480, 640, CV_8UC1, cv::Scalar(0))).frame, FrameOutcome::kDark);
  EXPECT_EQ(outcome_of(cv::Mat(480, 640, CV_8UC1, cv::Scalar(128))).frame,
            FrameOutcome::kFeatureless);
  EXPECT_EQ(outcome_of(cv::Mat(240, 320, CV_8UC1, cv::Scalar(9))).frame, FrameOutcome::kWrongSize);
  EXPECT_EQ(odometry.count(MotionOutcome::kUnfit), 4U);
  const OdometryOutput next = feed(odometry, frame);
  ASSERT_TRUE(next.motion);
  EXPECT_EQ(next.outcome, MotionOutcome::kMoved);
  EXPECT_EQ(next.motion->stamp_ns - next.motion->interval_start_ns, to_ns(5 / kRate));
  // The very same pixels, and a stamp from the past.
  EXPECT_EQ(odometry.process({image(frame), stamp_of(frame + 1), {}, {}}).outcome,
            MotionOutcome::kRepeated);
  EXPECT_EQ(feed(odometry, frame - 3).outcome, MotionOutcome::kNotLater);
}

TEST_F(OdometryOfACorridor, AGapOfTwoSecondsStartsAnewAndIsOwnedUpTo) {
  VisualOdometry odometry(config(), {}, camera_);
  std::optional<PoseEstimate> before;
  for (int i = 20; i < 40; ++i) {
    if (const auto pose = feed(odometry, i).odometry) before = pose;
  }
  ASSERT_TRUE(before);
  std::optional<PoseEstimate> after;
  OdometryOutput first = feed(odometry, 56 + 24);
  EXPECT_EQ(first.outcome, MotionOutcome::kAfterGap);
  EXPECT_FALSE(first.motion);
  for (int i = 56; i < 81 && !after; ++i) {
    OdometryInput input{image(i), stamp_of(i + 40), attitude_at(i), std::nullopt};
    after = odometry.process(input).odometry;
  }
  ASSERT_TRUE(after);
  EXPECT_GT(after->covariance(0, 0), before->covariance(0, 0) + 1.0);
}

TEST_F(OdometryOfACorridor, IsTheSameEachTime) {
  VisualOdometry first(config(), {}, camera_), second(config(), {}, camera_);
  for (int i = 18; i < 45; ++i) {
    const OdometryOutput a = feed(first, i), b = feed(second, i);
    ASSERT_EQ(a.motion.has_value(), b.motion.has_value());
    if (!a.motion) continue;
    EXPECT_EQ(a.motion->translation_m, b.motion->translation_m);
    EXPECT_EQ(a.motion->covariance, b.motion->covariance);
  }
}

}  // namespace
}  // namespace vpdr::vision
