#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <set>
#include <string>

#include "tests/unit/vision/corridor_image.hpp"
#include "vision/core/frame_check.hpp"

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

// A step of 70 becomes seven of 10: 7 * 10^2 of 70^2 is left, a seventh. A ramp stays a ramp.
// Changes to and fro at every pixel are lost but for 1/49.
TEST(Blur, ByHand) {
  cv::Mat step(64, 64, CV_8UC1, cv::Scalar(100));
  step.colRange(32, 64).setTo(170);
  step.rowRange(32, 64) += 30;
  EXPECT_NEAR(blur_of(step), 1.0 / 7.0, 1e-9);
  cv::Mat ramp(64, 64, CV_8UC1);
  cv::Mat comb(64, 64, CV_8UC1);
  for (int row = 0; row < 64; ++row) {
    for (int column = 0; column < 64; ++column) {
      ramp.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(row + 2 * column);
      comb.at<std::uint8_t>(row, column) =
          static_cast<std::uint8_t>(100 + 40 * (column % 2) + 30 * (row % 2));
    }
  }
  EXPECT_NEAR(blur_of(ramp), 1.0, 1e-9);
  EXPECT_NEAR(blur_of(comb), 1.0 / 49.0, 1e-9);
}

// Out of focus is refused; moved sideways is not, for the other edges stay sharp.
TEST(Blur, RefusesWhatIsBlurredBothWaysOnly) {
  cv::Mat noisy;
  cv::Mat noise(480, 640, CV_16SC1);
  cv::RNG random(5);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 2.0);
  cv::add(good(), noise, noisy, cv::noArray(), CV_8U);
  EXPECT_EQ(check(noisy), FrameOutcome::kFound);
  cv::Mat moved;
  cv::blur(noisy, moved, cv::Size(25, 1));
  EXPECT_EQ(check(moved), FrameOutcome::kFound);
  cv::Mat unfocused;
  cv::GaussianBlur(noisy, unfocused, cv::Size(), 8.0);
  EXPECT_EQ(check(unfocused), FrameOutcome::kBlurred);
  FrameCheckConfig lenient;
  lenient.max_blur = 1.0;
  EXPECT_EQ(check_frame(unfocused, 640, 480, lenient), FrameOutcome::kFound);
}

TEST(Fingerprint, TellsImagesApart) {
  EXPECT_EQ(fingerprint_of(good()), fingerprint_of(good()));
  cv::Mat other = good();
  other += 1;
  EXPECT_NE(fingerprint_of(good()), fingerprint_of(other));
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
