#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/rotation.hpp"
#include "vision/core/heading/edge_lines.hpp"

namespace vpdr::vision {
namespace {

// A straight edge through (x, y) at `angle_rad` to the x axis: dark above it, bright below, each
// pixel as grey as the share of it that is bright.
cv::Mat edge_through(double x, double y, double angle_rad, double dark, double bright) {
  cv::Mat image(240, 320, CV_8UC1);
  const double nx = -std::sin(angle_rad);
  const double ny = std::cos(angle_rad);
  for (int row = 0; row < image.rows; ++row) {
    for (int column = 0; column < image.cols; ++column) {
      double share = 0.0;
      for (int i = 0; i < 64; ++i) {
        const double u = column + (i % 8 + 0.5) / 8.0 - 0.5 - x;
        const double v = row + (i / 8 + 0.5) / 8.0 - 0.5 - y;
        share += (u * nx + v * ny > 0.0) / 64.0;
      }
      image.at<std::uint8_t>(row, column) =
          cv::saturate_cast<std::uint8_t>(dark + (bright - dark) * share);
    }
  }
  return image;
}

double length_of(const LineSegment& s) { return (s.end_px - s.start_px).norm(); }

LineSegment longest(const std::vector<LineSegment>& segments) {
  return *std::max_element(segments.begin(), segments.end(), [](const auto& a, const auto& b) {
    return length_of(a) < length_of(b);
  });
}

TEST(EdgeLines, AnEdgeIsFoundToASmallFractionOfAPixelAtAnyAngle) {
  EdgeLines lines({});
  for (const double angle_deg : {0.0, 3.0, 17.0, 30.0, 44.0, 46.0, 70.0, 90.0}) {
    const double a = to_radians(angle_deg);
    const cv::Mat image = edge_through(160.3, 120.2, a, 40.0, 200.0);
    const std::vector<LineSegment>& found = lines.detect(image);
    ASSERT_FALSE(found.empty()) << angle_deg;
    const LineSegment s = longest(found);
    EXPECT_GT(length_of(s), 230.0) << angle_deg;
    const Eigen::Vector2d normal(-std::sin(a), std::cos(a));
    EXPECT_NEAR(normal.dot(s.start_px - Eigen::Vector2d(160.3, 120.2)), 0.0, 0.07) << angle_deg;
    EXPECT_NEAR(normal.dot(s.end_px - Eigen::Vector2d(160.3, 120.2)), 0.0, 0.07) << angle_deg;
  }
}

TEST(EdgeLines, NoiseDoesNotBreakAnEdgeNorMakeOne) {
  EdgeLines lines({});
  cv::Mat image = edge_through(160.0, 120.0, to_radians(25.0), 80.0, 140.0);
  cv::Mat noise(image.size(), CV_16SC1);
  cv::RNG random(7);
  random.fill(noise, cv::RNG::NORMAL, 0.0, 4.0);
  cv::add(image, noise, image, cv::noArray(), CV_8U);
  const std::vector<LineSegment>& found = lines.detect(image);
  const LineSegment edge = longest(found);
  EXPECT_GT(length_of(edge), 200.0);
  const Eigen::Vector2d d = (edge.end_px - edge.start_px).normalized();
  EXPECT_NEAR(std::abs(d.y() / d.x()), std::tan(to_radians(25.0)), 0.005);
  const auto others = std::count_if(found.begin(), found.end(), [&](const LineSegment& s) {
    return length_of(s) > 24.0 && length_of(s) < length_of(edge);
  });
  EXPECT_LE(others, 2);
}

TEST(EdgeLines, FaintEdgesAndFlatImagesGiveNothing) {
  EdgeLines lines({});
  EXPECT_TRUE(lines.detect(edge_through(160.0, 120.0, 0.3, 100.0, 104.0)).empty());
  EXPECT_TRUE(lines.detect(cv::Mat(240, 320, CV_8UC1, cv::Scalar(90))).empty());
  EXPECT_TRUE(lines.detect(cv::Mat(3, 3, CV_8UC1, cv::Scalar(90))).empty());
}

// A dashed line of one pixel wide gaps is one segment as far as the gaps may be bridged.
TEST(EdgeLines, SmallGapsAreBridgedLargeOnesNot) {
  EdgeLines lines({});
  cv::Mat image(240, 320, CV_8UC1, cv::Scalar(30));
  image.rowRange(120, 240).setTo(200);
  cv::Mat gap = image.clone();
  gap.colRange(160, 161).setTo(30);
  EXPECT_GT(length_of(longest(lines.detect(gap))), 300.0);
  gap.colRange(160, 180).setTo(30);
  EXPECT_LT(length_of(longest(lines.detect(gap))), 170.0);
}

TEST(EdgeLines, SameImageSameSegmentsToTheLastBit) {
  cv::Mat image(240, 320, CV_8UC1);
  cv::RNG random(3);
  random.fill(image, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(image, image, cv::Size(), 2.0);
  EdgeLines first({});
  EdgeLines second({});
  static_cast<void>(second.detect(edge_through(10.0, 20.0, 0.3, 0.0, 255.0)));
  const std::vector<LineSegment> a = first.detect(image);
  const std::vector<LineSegment> b = second.detect(image);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(a.empty());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].start_px, b[i].start_px);
    EXPECT_EQ(a[i].end_px, b[i].end_px);
  }
}

}  // namespace
}  // namespace vpdr::vision
