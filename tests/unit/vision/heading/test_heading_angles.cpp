#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "core/rotation.hpp"
#include "tests/unit/vision/corridor_image.hpp"
#include "vision/core/heading/heading_angles.hpp"

namespace vpdr::vision {
namespace {

const Eigen::Vector2d kCentre(320.0, 240.0);
const Eigen::Vector2d kFocal(500.0, 400.0);

// S1.6 by hand: x - u = 250 at fx 500: theta = asin 0.5 = 30 deg; cos = 0.8660254;
// y - v = 100 at fy 400: phi = asin(100 / 346.41016) = asin 0.28867513 = 16.7786 deg.
TEST(ViewAngles, PrintedByHand) {
  const auto angles = printed_view_angles({570.0, 340.0}, kCentre, kFocal);
  ASSERT_TRUE(angles);
  EXPECT_NEAR(to_degrees(angles->heading_rad), 30.0, 1e-12);
  EXPECT_NEAR(to_degrees(angles->pitch_rad), 16.7786548810, 1e-9);
}

TEST(ViewAngles, PrintedSigns) {
  // Vanishing point right of the centre: the camera is turned to the left, positive.
  EXPECT_GT(printed_view_angles({400.0, 240.0}, kCentre, kFocal)->heading_rad, 0.0);
  EXPECT_LT(printed_view_angles({200.0, 240.0}, kCentre, kFocal)->heading_rad, 0.0);
  // Below the centre: the camera looks up, positive.
  EXPECT_GT(printed_view_angles({320.0, 300.0}, kCentre, kFocal)->pitch_rad, 0.0);
}

TEST(ViewAngles, PrintedHasNoValueBeyondItsArcsine) {
  EXPECT_FALSE(printed_view_angles({320.0 + 501.0, 240.0}, kCentre, kFocal));
  EXPECT_FALSE(printed_view_angles({320.0 + 490.0, 500.0}, kCentre, kFocal));
}

// A pinhole has x - u = fx tan(heading): the printed form is asin(tan(heading)).
TEST(ViewAngles, PrintedErrorGrowsWithTheAngle) {
  double last_error = 0.0;
  for (const double heading_deg : {5.0, 10.0, 20.0, 30.0, 40.0}) {
    const double heading = to_radians(heading_deg);
    const Eigen::Vector2d pixel(320.0 + 500.0 * std::tan(heading), 240.0);
    const auto printed = printed_view_angles(pixel, kCentre, kFocal);
    ASSERT_TRUE(printed);
    const double error = printed->heading_rad - heading;
    EXPECT_GT(error, 1.5 * last_error);
    last_error = error;
    const Eigen::Vector3d ray = Eigen::Vector3d((pixel.x() - 320.0) / 500.0, 0.0, 1.0).normalized();
    EXPECT_NEAR(ray_view_angles(ray).heading_rad, heading, 1e-14);
  }
  // 0.02 deg at 5 deg, 17 deg at 40 deg.
  EXPECT_NEAR(to_degrees(printed_view_angles({320.0 + 500.0 * std::tan(to_radians(5.0)), 240.0},
                                             kCentre, kFocal)
                             ->heading_rad),
              5.0192, 1e-4);
  EXPECT_NEAR(to_degrees(last_error), 17.0455, 1e-3);
}

TEST(ViewAngles, RayByHand) {
  // (1, 1, sqrt 2) / 2: 35.26 deg to the right, 30 deg below: heading atan(1/sqrt 2), pitch 30.
  const Eigen::Vector3d ray(0.5, 0.5, std::sqrt(0.5));
  EXPECT_NEAR(ray_view_angles(ray).heading_rad, std::atan2(1.0, std::sqrt(2.0)), 1e-14);
  EXPECT_NEAR(to_degrees(ray_view_angles(ray).pitch_rad), 30.0, 1e-12);
  EXPECT_NEAR(ray_view_angles({0.0, 0.0, -1.0}).heading_rad, kPi, 1e-15);
}

TEST(ViewAngles, LevelAnglesKnowTheRollThatTheRayFormIgnores) {
  const double heading = 0.4;
  const double pitch = 0.15;
  for (const double roll : {0.0, 0.1, -0.3}) {
    const Eigen::Matrix3d r = testing::looking(heading, pitch, roll);
    EXPECT_NEAR(level_view_angles(r).heading_rad, heading, 1e-12);
    EXPECT_NEAR(level_view_angles(r).pitch_rad, pitch, 1e-12);
  }
  // Unrolled and level, both forms agree.
  const Eigen::Matrix3d r = testing::looking(heading, 0.0, 0.0);
  EXPECT_NEAR(ray_view_angles(r.col(0)).heading_rad, heading, 1e-12);
  EXPECT_NEAR(ray_view_angles(testing::looking(0.0, pitch, 0.0).col(0)).pitch_rad, pitch, 1e-12);
}

// S1.7 by hand: alpha = 90, beta = 0, gamma = 0 deg turns x to y, y to -x.
TEST(Triplet, ByHand) {
  const Eigen::Matrix3d quarter = triplet_from_angles({0.5 * kPi, 0.0, 0.0});
  EXPECT_TRUE(quarter.col(0).isApprox(Eigen::Vector3d(0, 1, 0), 1e-15));
  EXPECT_TRUE(quarter.col(1).isApprox(Eigen::Vector3d(-1, 0, 0), 1e-15));
  EXPECT_TRUE(quarter.col(2).isApprox(Eigen::Vector3d(0, 0, 1), 1e-15));
  // alpha = 30, beta = -30, gamma = 60 deg: V1 = (3/4, sqrt3/4, 1/2).
  const Eigen::Matrix3d v =
      triplet_from_angles({to_radians(30.0), to_radians(-30.0), to_radians(60.0)});
  EXPECT_TRUE(v.col(0).isApprox(Eigen::Vector3d(0.75, std::sqrt(3.0) / 4.0, 0.5), 1e-14));
  // V2x = ca sb sg - sa cg = -(sqrt3/2)(1/2)(sqrt3/2) - (1/2)(1/2) = -0.625.
  EXPECT_NEAR(v(0, 1), -0.625, 1e-14);
  // V3z = cb cg = (sqrt3/2)(1/2).
  EXPECT_NEAR(v(2, 2), std::sqrt(3.0) / 4.0, 1e-14);
}

TEST(Triplet, IsTheProductOfThreeTurns) {
  const TripletAngles a{0.3, -0.7, 1.9};
  const Eigen::Matrix3d product = (Eigen::AngleAxisd(a.alpha_rad, Eigen::Vector3d::UnitZ()) *
                                   Eigen::AngleAxisd(a.beta_rad, Eigen::Vector3d::UnitY()) *
                                   Eigen::AngleAxisd(a.gamma_rad, Eigen::Vector3d::UnitX()))
                                      .toRotationMatrix();
  EXPECT_TRUE(triplet_from_angles(a).isApprox(product, 1e-14));
}

TEST(Triplet, ThereAndBack) {
  for (double alpha = -3.0; alpha < 3.1; alpha += 0.6) {
    for (double beta = -1.5; beta < 1.6; beta += 0.5) {
      for (double gamma = -3.0; gamma < 3.1; gamma += 0.6) {
        const TripletAngles back = angles_from_triplet(triplet_from_angles({alpha, beta, gamma}));
        EXPECT_NEAR(back.alpha_rad, alpha, 1e-9);
        EXPECT_NEAR(back.beta_rad, beta, 1e-9);
        EXPECT_NEAR(back.gamma_rad, gamma, 1e-9);
      }
    }
  }
}

TEST(Triplet, GimbalLockKeepsTheRotation) {
  const Eigen::Matrix3d v = triplet_from_angles({0.4, 0.5 * kPi, 0.9});
  const TripletAngles a = angles_from_triplet(v);
  EXPECT_EQ(a.gamma_rad, 0.0);
  EXPECT_TRUE(triplet_from_angles(a).isApprox(v, 1e-9));
}

TEST(Triplet, DisturbedDirectionsAreMadeOrthogonalFirst) {
  const TripletAngles truth{0.3, -0.2, 0.5};
  Eigen::Matrix3d v = triplet_from_angles(truth);
  v(0, 0) += 0.004;
  v(1, 1) -= 0.003;
  v(2, 0) += 0.002;
  const Eigen::Matrix3d r = nearest_rotation(v);
  EXPECT_TRUE((r.transpose() * r).isIdentity(1e-12));
  EXPECT_NEAR(r.determinant(), 1.0, 1e-12);
  EXPECT_NEAR(angles_from_triplet(v).alpha_rad, truth.alpha_rad, 0.006);
  EXPECT_NEAR(angles_from_triplet(v).beta_rad, truth.beta_rad, 0.006);
  EXPECT_NEAR(angles_from_triplet(v).gamma_rad, truth.gamma_rad, 0.006);
}

// S1.7 by hand: camera turned left by 30 degrees: in axes up, forward, left the
// corridor's forward direction is 30 degrees to the right of the camera's, (0, cos 30, -sin 30),
// which is V2 of gamma = -30.
TEST(TripletView, ByHand) {
  Eigen::Matrix3d r;  // camera axes: right, down, forward
  r.col(0) << 0.5, 0.0, std::sqrt(0.75);
  r.col(1) << -std::sqrt(0.75), 0.0, 0.5;
  r.col(2) << 0.0, -1.0, 0.0;
  const ViewAngles turned = triplet_view_angles(r);
  EXPECT_NEAR(to_degrees(turned.heading_rad), 30.0, 1e-9);
  EXPECT_NEAR(turned.pitch_rad, 0.0, 1e-12);
  EXPECT_NEAR(turned.roll_rad, 0.0, 1e-12);
}

TEST(TripletView, OneTurnAtATimeIsThatOfTheOtherForms) {
  for (const auto& [heading, pitch, roll] :
       {std::array{0.4, 0.0, 0.0}, std::array{0.0, 0.3, 0.0}, std::array{0.0, 0.0, -0.2},
        std::array{-0.5, 0.25, 0.0}, std::array{0.3, 0.0, 0.15}}) {
    const Eigen::Matrix3d r = testing::looking(heading, pitch, roll);
    const ViewAngles triplet = triplet_view_angles(r);
    const ViewAngles level = level_view_angles(r);
    EXPECT_NEAR(triplet.heading_rad, heading, 1e-12);
    EXPECT_NEAR(triplet.pitch_rad, pitch, 1e-12);
    EXPECT_NEAR(triplet.roll_rad, roll, 1e-12);
    EXPECT_NEAR(level.heading_rad, heading, 1e-12);
    EXPECT_NEAR(level.pitch_rad, pitch, 1e-12);
    EXPECT_NEAR(level.roll_rad, roll, 1e-12);
  }
}

// Pitched and rolled at once, the printed order (yaw, roll, pitch) and the optical axis differ by
// about their product.
TEST(TripletView, PitchAndRollTogetherSplitTheHeading) {
  const Eigen::Matrix3d r = testing::looking(0.2, 0.2, 0.1);
  EXPECT_NEAR(level_view_angles(r).heading_rad, 0.2, 1e-12);
  EXPECT_NEAR(std::abs(triplet_view_angles(r).heading_rad - 0.2), 0.02, 0.002);
}

}  // namespace
}  // namespace vpdr::vision
