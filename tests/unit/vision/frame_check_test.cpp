#include "vision/core/frame_check.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <set>
#include <string>

#include "tests/unit/vision/corridor_image.hpp"

namespace vpdr::vision {
namespace {

cv::Mat good() {
  return testing::draw_corridor(CameraModel(testing::plain_camera()),
                                testing::looking(0.1, 0.0, 0.0));
}

FrameOutcome check(const cv::Mat& image) { return check_frame(image, 640, 480, {}); }

TEST(FrameCheck, TakesAGoodFrameGreyOrColour) {
  EXPECT_EQ(check(good()), FrameOutcome::kFound);
  cv::Mat colour;
  cv::merge(std::vector<cv::Mat>{good(), good(), good()}, colour);
  EXPECT_EQ(check(colour), FrameOutcome::kFound);
  EXPECT_EQ(check_frame(good(), 0, 0, {}), FrameOutcome::kFound);
}

TEST(FrameCheck, RefusesWithItsReason) {
  EXPECT_EQ(check(cv::Mat()), FrameOutcome::kEmpty);
  EXPECT_EQ(check(cv::Mat(480, 640, CV_16UC1, cv::Scalar(100))), FrameOutcome::kWrongFormat);
  EXPECT_EQ(check(cv::Mat(480, 640, CV_8UC2, cv::Scalar(100, 1))), FrameOutcome::kWrongFormat);
  EXPECT_EQ(check(cv::Mat(240, 320, CV_8UC1, cv::Scalar(100))), FrameOutcome::kWrongSize);
  EXPECT_EQ(check_frame(cv::Mat(8, 8, CV_8UC1, cv::Scalar(1)), 0, 0, {}), FrameOutcome::kWrongSize);
  EXPECT_EQ(check(cv::Mat(480, 640, CV_8UC1, cv::Scalar(3))), FrameOutcome::kDark);
  EXPECT_EQ(check(cv::Mat(480, 640, CV_8UC1, cv::Scalar(254))), FrameOutcome::kSaturated);
  EXPECT_EQ(check(cv::Mat(480, 640, CV_8UC1, cv::Scalar(100))), FrameOutcome::kFeatureless);
}

TEST(FrameCheck, SeesThatTheLowerPartIsMissing) {
  cv::Mat torn = good();
  torn(cv::Rect(0, 400, 640, 80)).setTo(128);
  EXPECT_EQ(check(torn), FrameOutcome::kTorn);
  torn(cv::Rect(0, 400, 640, 80)).setTo(0);
  EXPECT_EQ(check(torn), FrameOutcome::kTorn);
  // A plain floor is none: decoders do not fill with its colour.
  torn(cv::Rect(0, 400, 640, 80)).setTo(117);
  EXPECT_EQ(check(torn), FrameOutcome::kFound);
  // A thin bar at the bottom, as a video player's border, is no tear.
  cv::Mat bar = good();
  bar(cv::Rect(0, 470, 640, 10)).setTo(128);
  EXPECT_EQ(check(bar), FrameOutcome::kFound);
}

TEST(FrameCheck, EveryOutcomeHasItsOwnName) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < kFrameOutcomeCount; ++i) {
    names.insert(name_of(static_cast<FrameOutcome>(i)));
  }
  EXPECT_EQ(names.size(), kFrameOutcomeCount);
}

}  // namespace
}  // namespace vpdr::vision
