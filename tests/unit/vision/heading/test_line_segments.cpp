#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/rotation.hpp"
#include "tests/unit/vision/corridor_image.hpp"
#include "vision/core/heading/line_segments.hpp"

namespace vpdr::vision {
namespace {

// A black rectangle whose edges lie between pixels: x = 99.5, 399.5, y = 79.5, 299.5.
cv::Mat rectangle(int enlarged) {
  cv::Mat image(480 * enlarged, 640 * enlarged, CV_8UC1, cv::Scalar(220));
  image(cv::Rect(100 * enlarged, 80 * enlarged, 300 * enlarged, 220 * enlarged)).setTo(20);
  return image;
}

TEST(LineDetector, EdgesAreWhereTheyAreAtAnySize) {
  LineDetector detector({});
  for (const int enlarged : {1, 2}) {
    int vertical = 0;
    int horizontal = 0;
    for (const LineSegment& s : detector.detect(rectangle(enlarged))) {
      const Eigen::Vector2d d = s.end_px - s.start_px;
      const Eigen::Vector2d middle = 0.5 * (s.start_px + s.end_px);
      // Edge of the enlarged image: e (edge + 0.5) - 0.5.
      const auto at = [&](double edge) { return enlarged * (edge + 0.5) - 0.5; };
      if (std::abs(d.x()) < std::abs(d.y())) {
        ++vertical;
        const double edge = middle.x() < 250.0 * enlarged ? at(99.5) : at(399.5);
        EXPECT_NEAR(middle.x(), edge, 0.05 * enlarged);
        EXPECT_NEAR(std::abs(d.y()), 220.0 * enlarged, 12.0 * enlarged);
      } else {
        ++horizontal;
        const double edge = middle.y() < 190.0 * enlarged ? at(79.5) : at(299.5);
        EXPECT_NEAR(middle.y(), edge, 0.05 * enlarged);
        EXPECT_NEAR(std::abs(d.x()), 300.0 * enlarged, 12.0 * enlarged);
      }
    }
    EXPECT_EQ(vertical, 2);
    EXPECT_EQ(horizontal, 2);
  }
}

TEST(LineDetector, LongestFirstAndNoneTooShortOrTooMany) {
  const cv::Mat image =
      testing::draw_corridor(CameraModel(testing::plain_camera()), testing::looking(0, 0, 0));
  LineConfig config;
  config.max_segments = 15;
  config.min_length_fraction = 0.04;  // of 800 px
  LineDetector detector(config);
  const std::vector<LineSegment>& segments = detector.detect(image);
  ASSERT_EQ(segments.size(), 15U);
  double last = 1e9;
  for (const LineSegment& s : segments) {
    const double length = (s.end_px - s.start_px).norm();
    EXPECT_LE(length, last);
    EXPECT_GE(length, 32.0);
    last = length;
  }
}

TEST(SphereSegment, ByHand) {
  CameraParameters p = testing::plain_camera();
  p.cx_px = p.cy_px = 0.0;
  const CameraModel camera(p);
  // From 500 px left to 500 px right of the centre at f = 500, straight across: 90 degrees of
  // arc in the plane y = 0, seen from (-1, 0, 1) to (1, 0, 1).
  std::vector<SphereSegment> out;
  lift_to_sphere({{{-500.0, 0.0}, {500.0, 0.0}}}, camera, 2000.0, 0.5, out);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_TRUE(out[0].normal.isApprox(Eigen::Vector3d(0, 1, 0), 1e-12));
  EXPECT_TRUE(out[0].middle.isApprox(Eigen::Vector3d(0, 0, 1), 1e-12));
  EXPECT_TRUE(out[0].along.isApprox(Eigen::Vector3d(1, 0, 0), 1e-12));
  EXPECT_DOUBLE_EQ(out[0].weight, 0.5);
  EXPECT_NEAR(out[0].tilt_sigma_rad, std::sqrt(2.0) * 0.5 / 1000.0, 1e-12);
  EXPECT_NEAR(out[0].shift_sigma_rad, 0.5 * (0.5 * kPi / 1000.0) / std::sqrt(2.0), 1e-12);
}

TEST(SphereSegment, APointSpansNoPlane) {
  std::vector<SphereSegment> out;
  lift_to_sphere({{{100.0, 100.0}, {100.0, 100.0}}}, CameraModel(testing::plain_camera()), 800.0,
                 0.5, out);
  EXPECT_TRUE(out.empty());
}

// An edge in space lies in the plane of its segment, whatever the lens.
TEST(SphereSegment, NormalIsPerpendicularToTheEdge) {
  CameraParameters p = testing::plain_camera();
  p.distortion = Distortion::kRadialTangential;
  p.coefficients = {-0.28, 0.07, 0.0002, 0.00002, 0.0};
  const CameraModel camera(p);
  const Eigen::Matrix3d r = testing::looking(0.3, -0.1, 0.05);
  std::vector<SphereSegment> out;
  lift_to_sphere(testing::random_segments(camera, r, {20, 0, 0}, 0, 0.0, 1), camera, 800.0, 0.5,
                 out);
  ASSERT_EQ(out.size(), 20U);
  for (const SphereSegment& s : out) {
    EXPECT_NEAR(s.normal.dot(r.col(0)), 0.0, 1e-9);
    EXPECT_NEAR(s.along.dot(s.normal.cross(s.middle)), 1.0, 1e-12);
  }
}

}  // namespace
}  // namespace vpdr::vision
