#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "core/rotation.hpp"
#include "tests/unit/vision/corridor_image.hpp"
#include "vision/core/heading/vanishing_point_heading.hpp"

namespace vpdr::vision {
namespace {

using testing::draw_corridor;
using testing::looking;

constexpr TimestampNs kFrame = kNsPerSecond / 10;

CameraParameters lens(Distortion distortion, std::array<double, 5> coefficients) {
  CameraParameters p = testing::plain_camera();
  p.distortion = distortion;
  p.coefficients = coefficients;
  return p;
}

// Body attitude of a forward-looking camera that stands so in the corridor; east = corridor.
AttitudePrior attitude(const Eigen::Matrix3d& camera_from_corridor, double turned_rad = 0.0) {
  AttitudePrior prior;
  prior.world_from_body = Eigen::Quaterniond(Eigen::Matrix3d(
      camera_from_corridor.transpose() * forward_looking_body_from_camera().transpose()));
  prior.turn = GyroTurn{turned_rad, 0};
  return prior;
}

class CorridorThroughEveryLens : public ::testing::TestWithParam<CameraParameters> {};

TEST_P(CorridorThroughEveryLens, HeadingAndPitchOfADrawnCorridor) {
  const CameraModel camera(GetParam());
  for (const bool with_prior : {false, true}) {
    for (const double heading_deg : {-25.0, -8.0, 0.0, 5.0, 20.0}) {
      for (const double pitch_deg : {-8.0, 4.0}) {
        const Eigen::Matrix3d r =
            looking(to_radians(heading_deg), to_radians(pitch_deg), to_radians(3.0));
        VanishingPointHeading vision({}, camera);
        const VisionOutput out =
            vision.process(draw_corridor(camera, r), 1,
                           with_prior ? std::optional<AttitudePrior>(attitude(r)) : std::nullopt);
        ASSERT_EQ(out.outcome, FrameOutcome::kFound)
            << name_of(out.outcome) << ' ' << heading_deg << ' ' << pitch_deg << ' ' << with_prior;
        EXPECT_NEAR(to_degrees(out.heading.heading_rad), heading_deg, 0.7);
        EXPECT_NEAR(to_degrees(out.heading.pitch_rad), pitch_deg, 0.7);
        EXPECT_LT(to_degrees(out.heading.sigma_rad), 1.5);
        EXPECT_GE(out.heading.inliers, 6U);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Lenses, CorridorThroughEveryLens,
    ::testing::Values(lens(Distortion::kNone, {}),
                      lens(Distortion::kRadialTangential, {-0.283, 0.074, 0.0002, 0.00002, 0.0}),
                      lens(Distortion::kEquidistant, {-0.013, 0.02, -0.012, 0.0025, 0.0})));

TEST(VanishingPointHeading, VanishingPointRightOfTheCentreIsAPositiveHeading) {
  const CameraModel camera(testing::plain_camera());
  const Eigen::Matrix3d r = looking(0.2, 0.0, 0.0);
  ASSERT_GT(camera.pixel(r.col(0))->x(), 319.5);
  VanishingPointHeading vision({}, camera);
  EXPECT_GT(vision.process(draw_corridor(camera, r), 1, std::nullopt).heading.heading_rad, 0.15);
}

TEST(VanishingPointHeading, PrintedFormIsSelectableAndFurtherOff) {
  const CameraModel camera(testing::plain_camera());
  VisionConfig config;
  config.angle_form = AngleForm::kAsPrinted;
  const double heading = to_radians(20.0);
  VanishingPointHeading vision(config, camera);
  const VisionOutput out =
      vision.process(draw_corridor(camera, looking(heading, 0.0, 0.0)), 1, std::nullopt);
  ASSERT_TRUE(out.heading.found);
  // asin(tan 20 deg) = 21.343 deg.
  EXPECT_NEAR(to_degrees(out.heading.heading_rad), 21.343, 0.7);
}

TEST(VanishingPointHeading, AFrameThatRepeatsTheLastOneIsNoNews) {
  const CameraModel camera(testing::plain_camera());
  VanishingPointHeading vision({}, camera);
  const cv::Mat image = draw_corridor(camera, looking(0.1, 0.0, 0.0));
  EXPECT_EQ(vision.process(image, kFrame, std::nullopt).outcome, FrameOutcome::kFound);
  const VisionOutput again = vision.process(image.clone(), 2 * kFrame, std::nullopt);
  EXPECT_EQ(again.outcome, FrameOutcome::kRepeated);
  EXPECT_FALSE(again.heading.found);
  EXPECT_FALSE(again.rate);
  const cv::Mat next = draw_corridor(camera, looking(0.11, 0.0, 0.0));
  EXPECT_EQ(vision.process(next, 3 * kFrame, std::nullopt).outcome, FrameOutcome::kFound);
  // Dark again and again is dark.
  const cv::Mat dark(480, 640, CV_8UC1, cv::Scalar(2));
  EXPECT_EQ(vision.process(dark, 4 * kFrame, std::nullopt).outcome, FrameOutcome::kDark);
  EXPECT_EQ(vision.process(dark, 5 * kFrame, std::nullopt).outcome, FrameOutcome::kDark);
}

TEST(VanishingPointHeading, TripletFormIsSelectableAndKnowsTheRoll) {
  const CameraModel camera(testing::plain_camera());
  VisionConfig config;
  config.angle_form = AngleForm::kTriplet;
  VanishingPointHeading vision(config, camera);
  const Eigen::Matrix3d r = looking(to_radians(20.0), to_radians(-5.0), to_radians(6.0));
  const VisionOutput out = vision.process(draw_corridor(camera, r), 1, std::nullopt);
  ASSERT_TRUE(out.heading.found);
  const ViewAngles truth = triplet_view_angles(r);
  EXPECT_NEAR(to_degrees(out.heading.heading_rad), to_degrees(truth.heading_rad), 0.5);
  EXPECT_NEAR(to_degrees(out.heading.pitch_rad), to_degrees(truth.pitch_rad), 0.5);
  EXPECT_NEAR(to_degrees(out.roll_rad), to_degrees(truth.roll_rad), 0.5);
}

TEST(VanishingPointHeading, TurnsRoundInTheCorridorAndKeepsCount) {
  const CameraModel camera(testing::plain_camera());
  for (const bool with_prior : {false, true}) {
    VanishingPointHeading vision({}, camera);
    int found = 0;
    int rates = 0;
    double last = 0.0;
    const int frames = 31;
    for (int i = 0; i < frames; ++i) {
      const double truth = to_radians(-6.0 * i);  // half a turn to the right at 60 deg/s
      const Eigen::Matrix3d r = looking(truth, to_radians(-3.0), 0.0);
      const VisionOutput out = vision.process(
          draw_corridor(camera, r), (i + 1) * kFrame,
          with_prior ? std::optional<AttitudePrior>(attitude(r, truth)) : std::nullopt);
      if (!out.heading.found) continue;
      ++found;
      last = truth;
      EXPECT_NEAR(to_degrees(out.heading.heading_rad), to_degrees(truth), 1.5);
      if (out.rate) {
        ++rates;
        EXPECT_NEAR(to_degrees(out.rate->rate_radps), -60.0, 20.0);
      }
    }
    EXPECT_GE(found, frames * 8 / 10) << with_prior;
    EXPECT_GE(rates, frames * 7 / 10) << with_prior;
    EXPECT_LT(last, to_radians(-160.0));
  }
}

TEST(VanishingPointHeading, SaysWhenThereIsNoCorridor) {
  const CameraModel camera(testing::plain_camera());
  VanishingPointHeading vision({}, camera);
  cv::Mat noise(480, 640, CV_8UC1);
  cv::RNG random(5);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  const VisionOutput out = vision.process(noise, 1, std::nullopt);
  EXPECT_FALSE(out.heading.found);
  EXPECT_TRUE(out.outcome == FrameOutcome::kFewLines || out.outcome == FrameOutcome::kNoCorridor)
      << name_of(out.outcome);
}

TEST(VanishingPointHeading, RefusedFramesAreCountedAndLeaveNoTrace) {
  const CameraModel camera(testing::plain_camera());
  const cv::Mat good = draw_corridor(camera, looking(0.1, 0.0, 0.0));
  VanishingPointHeading vision({}, camera);
  VanishingPointHeading undisturbed({}, camera);
  EXPECT_TRUE(vision.process(good, kFrame, std::nullopt).heading.found);
  undisturbed.process(good, kFrame, std::nullopt);
  EXPECT_EQ(vision.process(cv::Mat(), 2 * kFrame, std::nullopt).outcome, FrameOutcome::kEmpty);
  EXPECT_EQ(vision.process(good(cv::Rect(0, 0, 320, 240)), 3 * kFrame, std::nullopt).outcome,
            FrameOutcome::kWrongSize);
  EXPECT_EQ(vision.process(good, 3 * kFrame, std::nullopt).outcome, FrameOutcome::kNotLater);
  EXPECT_EQ(vision.count(FrameOutcome::kFound), 1U);
  EXPECT_EQ(vision.count(FrameOutcome::kEmpty), 1U);
  EXPECT_EQ(vision.count(FrameOutcome::kWrongSize), 1U);
  EXPECT_EQ(vision.count(FrameOutcome::kNotLater), 1U);
  const cv::Mat next = draw_corridor(camera, looking(0.12, 0.0, 0.0));
  const VisionOutput a = vision.process(next, 4 * kFrame, std::nullopt);
  const VisionOutput b = undisturbed.process(next, 4 * kFrame, std::nullopt);
  EXPECT_EQ(a.heading.heading_rad, b.heading.heading_rad);
  ASSERT_TRUE(a.rate && b.rate);
  EXPECT_EQ(a.rate->rate_radps, b.rate->rate_radps);
}

}  // namespace
}  // namespace vpdr::vision
