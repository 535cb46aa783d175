#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/rotation.hpp"
#include "tests/unit/vision/corridor_image.hpp"
#include "vision/core/heading/heading_angles.hpp"
#include "vision/core/heading/manhattan_search.hpp"

namespace vpdr::vision {
namespace {

const CameraModel& camera() {
  static const CameraModel kCamera(testing::plain_camera());
  return kCamera;
}

std::vector<SphereSegment> segments(const Eigen::Matrix3d& r, const std::vector<int>& along,
                                    int clutter, double noise_px, unsigned seed) {
  std::vector<SphereSegment> out;
  lift_to_sphere(testing::random_segments(camera(), r, along, clutter, noise_px, seed), camera(),
                 800.0, 0.7, out);
  return out;
}

double quarter_wrapped(double a) { return a - 0.5 * kPi * std::round(a / (0.5 * kPi)); }

TEST(SquaredSine, ByHand) {
  SphereSegment s;  // a segment along y at the image centre
  s.normal = Eigen::Vector3d::UnitX();
  s.middle = Eigen::Vector3d::UnitZ();
  s.along = Eigen::Vector3d::UnitY();
  EXPECT_DOUBLE_EQ(squared_sine_to(s, Eigen::Vector3d::UnitY()), 0.0);
  EXPECT_DOUBLE_EQ(squared_sine_to(s, Eigen::Vector3d::UnitX()), 1.0);
  // Towards the upper right, 30 degrees off the segment: sin^2 = 1/4.
  EXPECT_NEAR(squared_sine_to(s, Eigen::Vector3d(0.5, std::sqrt(0.75), 0.3)), 0.25, 1e-12);
}

TEST(ManhattanSearch, ExactSegmentsGiveTheExactFrame) {
  ManhattanSearch search({});
  for (const double heading : {-0.6, -0.2, 0.0, 0.35, 0.7}) {
    for (const double roll : {-0.1, 0.08}) {
      const Eigen::Matrix3d r = testing::looking(heading, -0.12, roll);
      const auto frame = search.search(segments(r, {25, 15, 15}, 0, 0.0, 3), std::nullopt);
      ASSERT_TRUE(frame);
      EXPECT_NEAR(level_view_angles(frame->camera_from_corridor).heading_rad, heading, 2e-3);
      EXPECT_NEAR(level_view_angles(frame->camera_from_corridor).pitch_rad, -0.12, 2e-3);
    }
  }
}

TEST(ManhattanSearch, TheVerticalPriorLeavesOneNumberToSearch) {
  ManhattanSearch search({});
  for (const double heading : {-0.7, -0.3, 0.1, 0.5}) {
    const Eigen::Matrix3d r = testing::looking(heading, 0.2, -0.15);
    const VerticalPrior prior{exp_rotation({0.012, 0.0, -0.012}) * r.col(2), 0.03};
    const auto frame = search.search(segments(r, {20, 8, 0}, 30, 0.5, 4), prior);
    ASSERT_TRUE(frame);
    EXPECT_NEAR(level_view_angles(frame->camera_from_corridor).heading_rad, heading, 0.015);
  }
}

TEST(ManhattanSearch, ForwardIsTheHorizontalNearestToTheOpticalAxis) {
  ManhattanSearch search({});
  // Turned 60 degrees left of the corridor: its cross direction is nearer, 30 degrees to the left.
  const Eigen::Matrix3d r = testing::looking(to_radians(60.0), 0.0, 0.0);
  const auto frame = search.search(segments(r, {20, 20, 20}, 0, 0.2, 5), std::nullopt);
  ASSERT_TRUE(frame);
  EXPECT_NEAR(to_degrees(level_view_angles(frame->camera_from_corridor).heading_rad), -30.0, 0.5);
  EXPECT_NEAR(frame->camera_from_corridor.determinant(), 1.0, 1e-9);
}

TEST(ManhattanSearch, HalfOfTheSegmentsMayBeClutter) {
  ManhattanSearch search({});
  int good = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const double heading = -0.7 + 0.035 * seed;
    const Eigen::Matrix3d r = testing::looking(heading, 0.1, 0.05);
    const auto frame = search.search(segments(r, {20, 12, 16}, 48, 0.5, seed), std::nullopt);
    ASSERT_TRUE(frame);
    const double error =
        quarter_wrapped(level_view_angles(frame->camera_from_corridor).heading_rad - heading);
    good += std::abs(error) < to_radians(1.5);
  }
  EXPECT_GE(good, 39);
}

// Sigma is honest: over many noisy views without clutter, error over sigma has a spread of about
// one. A view in a hundred may end in a neighbouring optimum.
TEST(ManhattanSearch, SigmaMatchesTheScatter) {
  SearchConfig config;
  config.refine.model_sigma_rad = 0.0;
  ManhattanSearch search(config);
  std::vector<double> squares;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const double heading = -0.5 + 0.005 * seed;
    const Eigen::Matrix3d r = testing::looking(heading, 0.0, 0.0);
    const VerticalPrior prior{r.col(2), 0.03};
    const auto frame = search.search(segments(r, {15, 10, 12}, 0, 0.7, seed), prior);
    ASSERT_TRUE(frame);
    const double error =
        quarter_wrapped(level_view_angles(frame->camera_from_corridor).heading_rad - heading);
    const Eigen::Vector3d up = frame->camera_from_corridor.col(2);
    squares.push_back(error * error / up.dot(frame->covariance_rad2 * up));
  }
  std::sort(squares.begin(), squares.end());
  squares.resize(198);
  const double rms = std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / 198.0);
  EXPECT_GT(rms, 0.8);
  EXPECT_LT(rms, 1.25);
}

// A wall two degrees off square: the frame bends by part of it, its free direction follows it.
TEST(FreeDirections, AWallThatIsNotSquareIsFollowed) {
  const Eigen::Matrix3d r = testing::looking(0.3, 0.05, 0.0);
  const double askew = to_radians(2.0);
  const Eigen::Matrix3d turned =
      r * Eigen::AngleAxisd(askew, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  std::vector<SphereSegment> all = segments(r, {40, 0, 40}, 0, 0.1, 11);
  const std::vector<SphereSegment> wall = segments(turned, {0, 20, 0}, 0, 0.1, 12);
  all.insert(all.end(), wall.begin(), wall.end());
  RefineConfig config;
  const ManhattanFrame frame = refine_frame(all, r, {r.col(2), 0.03}, config);
  const auto free = free_directions(all, frame.camera_from_corridor, config, {});
  const auto off = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::acos(std::min(1.0, a.dot(b)));
  };
  EXPECT_GT(off(frame.camera_from_corridor.col(1), turned.col(1)), 0.3 * askew);
  EXPECT_LT(off(free[1].direction, turned.col(1)), 0.2 * askew);
  EXPECT_LT(off(free[0].direction, r.col(0)), 0.15 * askew);
  EXPECT_LT(off(free[2].direction, r.col(2)), 0.15 * askew);
}

// Without segments of its own a direction stays where the frame has it, and says so.
TEST(FreeDirections, NoSegmentsNoNews) {
  const Eigen::Matrix3d r = testing::looking(0.3, 0.05, 0.0);
  FreeConfig config;
  const auto free = free_directions(segments(r, {30, 0, 30}, 0, 0.1, 13), r, {}, config);
  EXPECT_TRUE(free[1].direction.isApprox(r.col(1), 1e-12));
  EXPECT_NEAR(free[1].variance_rad2, 2.0 * std::pow(config.orthogonality_sigma_rad, 2), 1e-12);
}

TEST(ManhattanSearch, SameSegmentsSameAnswerToTheLastBit) {
  const auto s = segments(testing::looking(0.2, 0.1, 0.0), {20, 10, 10}, 20, 1.0, 9);
  ManhattanSearch first({});
  ManhattanSearch second({});
  const auto other = segments(testing::looking(-0.5, 0.0, 0.1), {5, 5, 5}, 60, 1.0, 10);
  ASSERT_TRUE(second.search(other, std::nullopt));  // an earlier search leaves no trace
  const auto a = first.search(s, std::nullopt);
  const auto b = second.search(s, std::nullopt);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->camera_from_corridor, b->camera_from_corridor);
  EXPECT_EQ(a->covariance_rad2, b->covariance_rad2);
}

TEST(ManhattanSearch, NothingFromNothing) {
  ManhattanSearch search({});
  EXPECT_FALSE(search.search({}, std::nullopt));
  const auto two = segments(testing::looking(0, 0, 0), {2, 0, 0}, 0, 0.0, 1);
  EXPECT_FALSE(search.search(two, std::nullopt));
}

TEST(ManhattanSearch, LookingStraightDownHasNoHeading) {
  ManhattanSearch search({});
  const auto s = segments(testing::looking(0.0, 0.0, 0.0), {10, 10, 10}, 0, 0.0, 1);
  EXPECT_FALSE(search.search(s, VerticalPrior{-Eigen::Vector3d::UnitZ(), 0.03}));
}

}  // namespace
}  // namespace vpdr::vision
