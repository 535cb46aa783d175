#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "pdr/core/attitude/initial_attitude.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Vector3d;

constexpr double kTight = 1e-12;

TEST(SurveyTilt, PrintsGravityOfTwoEight) {
  // pitch 30, roll 60 deg: g [sin r cos p, -sin p, -cos r cos p] = g [0.75, -0.5, -0.4330127].
  const Vector3d f = survey_gravity({to_radians(30.0), to_radians(60.0)}, 10.0);
  EXPECT_NEAR(f.x(), 7.5, 1e-9);
  EXPECT_NEAR(f.y(), -5.0, 1e-9);
  EXPECT_NEAR(f.z(), -4.330127, 1e-6);
}

TEST(SurveyTilt, InvertsGravityByTwoNineAndTwoTen) {
  const SurveyTilt tilt = survey_tilt({7.5, -5.0, -4.330127});
  EXPECT_NEAR(to_degrees(tilt.pitch_rad), 30.0, 1e-6);
  EXPECT_NEAR(to_degrees(tilt.roll_rad), 60.0, 1e-6);
}

TEST(SurveyTilt, NoseUpIsPositivePitchAndRightDownPositiveRoll) {
  // The accelerometer reads up; y forward tilted up by 10 deg reads +g sin 10 on y.
  const Vector3d nose_up(0.0, std::sin(to_radians(10.0)), std::cos(to_radians(10.0)));
  EXPECT_NEAR(to_degrees(survey_tilt(-nose_up).pitch_rad), 10.0, 1e-9);
  // Right side down by 20 deg: up shows on -x.
  const Vector3d right_down(-std::sin(to_radians(20.0)), 0.0, std::cos(to_radians(20.0)));
  EXPECT_NEAR(to_degrees(survey_tilt(-right_down).roll_rad), 20.0, 1e-9);
}

TEST(SurveyTilt, TakesTheArcsineWhereTheVerticalComponentIsSmall) {
  // roll 87 deg: |f_z| = 0.052 g < 0.1 g.
  const SurveyTilt tilt = survey_tilt(survey_gravity({to_radians(20.0), to_radians(87.0)}, 9.8));
  EXPECT_NEAR(to_degrees(tilt.pitch_rad), 20.0, 1e-9);
  EXPECT_NEAR(to_degrees(tilt.roll_rad), 87.0, 1e-9);
}

TEST(SurveyTilt, RoundTripsOverItsRange) {
  for (double pitch = -85.0; pitch <= 85.0; pitch += 5.0) {
    for (double roll = -89.0; roll <= 89.0; roll += 4.0) {
      const SurveyTilt tilt =
          survey_tilt(survey_gravity({to_radians(pitch), to_radians(roll)}, 9.81));
      EXPECT_NEAR(to_degrees(tilt.pitch_rad), pitch, 1e-6);
      EXPECT_NEAR(to_degrees(tilt.roll_rad), roll, 1e-6);
    }
  }
}

TEST(SurveyTilt, GivesZeroForNoForce) {
  const SurveyTilt tilt = survey_tilt(Vector3d::Zero());
  EXPECT_EQ(tilt.pitch_rad, 0.0);
  EXPECT_EQ(tilt.roll_rad, 0.0);
}

TEST(SurveyLevelField, MatrixOfTwoElevenByHand) {
  // pitch 90, roll 0: [[1 0 0] [0 0 -1] [0 1 0]].
  const Vector3d h = survey_level_field({0.5 * kPi, 0.0}, {1.0, 2.0, 3.0});
  EXPECT_NEAR(h.x(), 1.0, kTight);
  EXPECT_NEAR(h.y(), -3.0, kTight);
  EXPECT_NEAR(h.z(), 2.0, kTight);
  // pitch 0, roll 90: [[0 0 1] [0 1 0] [-1 0 0]].
  const Vector3d k = survey_level_field({0.0, 0.5 * kPi}, {1.0, 2.0, 3.0});
  EXPECT_NEAR(k.x(), 3.0, kTight);
  EXPECT_NEAR(k.y(), 2.0, kTight);
  EXPECT_NEAR(k.z(), -1.0, kTight);
}

TEST(SurveyLevelField, IsTheRotationFromBodyToLevel) {
  const SurveyTilt tilt{0.3, -0.7};
  const Eigen::Quaterniond turn = Eigen::AngleAxisd(tilt.pitch_rad, Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(tilt.roll_rad, Vector3d::UnitY());
  const Vector3d m(12.0, -30.0, 41.0);
  EXPECT_LT((survey_level_field(tilt, m) - turn * m).norm(), 1e-12);
}

TEST(SurveyYaw, FacesTheFourWindsCounterClockwiseFromNorth) {
  EXPECT_NEAR(to_degrees(survey_yaw({0.0, 1.0, 0.0})), 0.0, 1e-9);     // north
  EXPECT_NEAR(to_degrees(survey_yaw({1.0, 0.0, 0.0})), 90.0, 1e-9);    // west: north on the right
  EXPECT_NEAR(to_degrees(survey_yaw({0.0, -1.0, 0.0})), 180.0, 1e-9);  // south
  EXPECT_NEAR(to_degrees(survey_yaw({-1.0, 0.0, 0.0})), 270.0, 1e-9);  // east
}

TEST(SurveyYaw, EqualsTheWrappedArctangentOfTwoArguments) {
  for (int degree = 0; degree < 3600; ++degree) {
    const double angle = to_radians(0.1 * degree);
    const Vector3d h(20.0 * std::sin(angle), 20.0 * std::cos(angle), -40.0);
    const double expected = wrap_two_pi(std::atan2(h.x(), h.y()));
    EXPECT_NEAR(wrap_pi(survey_yaw(h) - expected), 0.0, 1e-12) << 0.1 * degree;
  }
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      EXPECT_NEAR(survey_yaw({x, y, 5.0}), wrap_two_pi(std::atan2(x, y)), 1e-12) << x << " " << y;
    }
  }
}

TEST(SurveyYaw, SixCasesAreAQuarterTurnBehindAndFlipAtTheirLine) {
  for (int degree = 0; degree < 360; ++degree) {
    const double angle = to_radians(degree + 0.5);
    const Vector3d h(std::sin(angle), std::cos(angle), 0.0);
    EXPECT_NEAR(wrap_pi(survey_yaw(h) - survey_yaw_six_cases(h) - 0.5 * kPi), 0.0, 1e-9);
  }
  // h_y changes sign on the line h_x = 0: 90 against 270 deg.
  EXPECT_NEAR(to_degrees(survey_yaw_six_cases({0.0, -1e-9, 0.0})), 90.0, 1e-9);
  EXPECT_NEAR(to_degrees(survey_yaw_six_cases({0.0, 1e-9, 0.0})), 270.0, 1e-9);
  EXPECT_EQ(survey_yaw_six_cases({1.0, 0.0, 0.0}), 0.0);
  EXPECT_NEAR(survey_yaw_six_cases({-1.0, 0.0, 0.0}), kPi, kTight);
}

TEST(LevelAttitude, TakesTheReadingUprightWithYawZero) {
  for (const Vector3d& up :
       {Vector3d(0.1, 0.2, 1.0), Vector3d(0.9, -0.3, 0.2), Vector3d(0.2, 0.4, -0.8),
        Vector3d(0.0, 0.0, -1.0), Vector3d(0.6, 0.5, 0.01)}) {
    const Eigen::Quaterniond q = level_attitude(9.81 * up);
    EXPECT_LT((q * up.normalized() - Vector3d::UnitZ()).norm(), 1e-9);
  }
  EXPECT_NEAR(yaw_of(level_attitude({1.0, 0.0, 9.7})), 0.0, 1e-9);
}

TEST(InitialAttitude, RecoversAnyAttitudeFromItsReadings) {
  const Vector3d north_down(0.0, 20.0, -40.0);
  for (double yaw = -170.0; yaw < 180.0; yaw += 35.0) {
    for (double pitch = -80.0; pitch <= 80.0; pitch += 20.0) {
      for (double roll = -170.0; roll <= 180.0; roll += 25.0) {
        const Eigen::Quaterniond truth =
            from_euler({to_radians(roll), to_radians(pitch), to_radians(yaw)});
        const Eigen::Quaterniond q = initial_attitude(
            truth.conjugate() * Vector3d(0.0, 0.0, kGravityMps2), truth.conjugate() * north_down);
        EXPECT_LT(q.angularDistance(truth), 1e-9) << yaw << " " << pitch << " " << roll;
      }
    }
  }
}

}  // namespace
}  // namespace vpdr::pdr
