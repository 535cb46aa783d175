#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <random>

#include "core/rotation.hpp"
#include "vision/core/odometry/relative_motion.hpp"

namespace vpdr::vision {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSigma = 1e-3;  // of a ray: half a pixel at 500 px

struct Scene {
  Matrix3d earlier_from_later = Matrix3d::Identity();
  Vector3d moved = Vector3d::Zero();
  std::vector<RayPair> pairs;
};

Vector3d disturbed(const Vector3d& ray, double sigma, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, sigma);
  return (ray + Vector3d(normal(random), normal(random), normal(random))).normalized();
}

/// Points 2 to 8 m ahead, or on a plane; a share of them is wrong.
Scene make_scene(const Vector3d& turn, const Vector3d& moved, bool plane, double wrong,
                 unsigned seed, double sigma = kSigma) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> side(-1.0, 1.0), depth(2.0, 8.0), chance(0.0, 1.0);
  Scene scene;
  scene.earlier_from_later = exp_rotation(turn).toRotationMatrix();
  scene.moved = moved;
  for (int i = 0; i < 120; ++i) {
    const double x = side(random), y = 0.7 * side(random);
    const double z = plane ? 4.0 / (1.0 + 0.4 * x + 0.2 * y) : depth(random);
    const Vector3d point(x * z * 0.6, y * z * 0.6, z);
    Vector3d later = scene.earlier_from_later.transpose() * (point - moved);
    if (chance(random) < wrong) later += Vector3d(side(random), side(random), 0.0);
    scene.pairs.push_back({disturbed(point.normalized(), sigma, random),
                           disturbed(later.normalized(), sigma, random)});
  }
  return scene;
}

double angle_between(const Matrix3d& a, const Matrix3d& b) {
  return Eigen::AngleAxisd(a * b.transpose()).angle();
}

struct Case {
  Vector3d turn, moved;
};

class TwoFrames : public testing::TestWithParam<Case> {};

TEST_P(TwoFrames, GiveRotationAndDirectionDespiteWrongPoints) {
  for (const bool with_gyro : {false, true}) {
    const Scene scene = make_scene(GetParam().turn, GetParam().moved, false, 0.2, 7);
    std::optional<RotationPrior> prior;
    if (with_gyro) {
      prior = RotationPrior{
          scene.earlier_from_later * exp_rotation({0.002, -0.001, 0.001}).toRotationMatrix(),
          0.003};
    }
    RelativeMotionEstimator estimator;
    const RelativeMotion motion = estimator.estimate(scene.pairs, kSigma, prior);
    EXPECT_EQ(motion.model, MotionModel::kEssential);
    EXPECT_LT(angle_between(motion.earlier_from_later, scene.earlier_from_later), 0.004);
    EXPECT_GT(motion.direction.dot(scene.moved.normalized()), std::cos(0.06));
    EXPECT_GT(motion.inliers, 80U);
    EXPECT_GT(motion.parallax_rad, 0.01);
  }
}

INSTANTIATE_TEST_SUITE_P(Motions, TwoFrames,
                         testing::Values(Case{{0, 0, 0}, {0, 0, 0.4}},
                                         Case{{0.02, -0.05, 0.03}, {0.3, 0.0, 0.1}},
                                         Case{{-0.1, 0.1, 0.05}, {-0.2, 0.1, -0.3}},
                                         Case{{0.0, 0.2, 0.0}, {0.4, -0.1, 0.2}}));

TEST(RelativeMotion, ATurnAloneIsARotation) {
  const Scene scene = make_scene({0.05, -0.1, 0.02}, Vector3d::Zero(), false, 0.2, 3);
  RelativeMotionEstimator estimator;
  const RelativeMotion motion = estimator.estimate(scene.pairs, kSigma, std::nullopt);
  EXPECT_EQ(motion.model, MotionModel::kRotation);
  EXPECT_LT(angle_between(motion.earlier_from_later, scene.earlier_from_later), 0.001);
  EXPECT_TRUE(motion.direction.isZero());
}

TEST(RelativeMotion, APlaneIsAHomography) {
  const Scene scene = make_scene({0.02, -0.03, 0.01}, {0.3, 0.1, 0.2}, true, 0.1, 11);
  RelativeMotionEstimator estimator;
  const RotationPrior prior{scene.earlier_from_later, 0.002};
  const RelativeMotion motion = estimator.estimate(scene.pairs, kSigma, prior);
  EXPECT_EQ(motion.model, MotionModel::kHomography);
  EXPECT_LT(angle_between(motion.earlier_from_later, scene.earlier_from_later), 0.01);
  EXPECT_GT(motion.direction.dot(scene.moved.normalized()), std::cos(0.1));
}

TEST(RelativeMotion, AHomographyComesApartIntoItsMotions) {
  const Matrix3d rotation = exp_rotation({0.1, -0.2, 0.05}).toRotationMatrix();
  const Vector3d movement(0.1, -0.05, 0.2), normal = Vector3d(0.2, 0.1, 1.0).normalized();
  const Matrix3d h = 1.7 * rotation * (Matrix3d::Identity() - movement * normal.transpose());
  double closest = 1.0;
  for (const PlaneMotion& m : decompose_homography(h)) {
    closest = std::min(closest, (m.later_from_earlier - rotation).norm() +
                                    (m.movement - movement).norm() + (m.normal - normal).norm());
  }
  EXPECT_LT(closest, 1e-9);
  EXPECT_TRUE(decompose_homography(rotation).empty());
}

TEST(RelativeMotion, SaysHowUncertainItIs) {
  RelativeMotionEstimator estimator;
  double rotation_nees = 0.0, direction_nees = 0.0;
  constexpr int kRuns = 40;
  for (unsigned seed = 0; seed < kRuns; ++seed) {
    const Scene scene = make_scene({0.02, -0.05, 0.03}, {0.3, 0.0, 0.3}, false, 0.0, seed);
    const RelativeMotion motion = estimator.estimate(scene.pairs, kSigma, std::nullopt);
    ASSERT_EQ(motion.model, MotionModel::kEssential);
    const Vector3d off = log_rotation(
        Eigen::Quaterniond(motion.earlier_from_later * scene.earlier_from_later.transpose()));
    rotation_nees += off.dot(motion.covariance.topLeftCorner<3, 3>().inverse() * off) / 3.0;
    const Vector3d truth = scene.moved.normalized();
    const Vector3d side = motion.direction.unitOrthogonal();
    const double error = side.dot(motion.direction - truth);
    direction_nees += error * error / side.dot(motion.covariance.bottomRightCorner<3, 3>() * side);
  }
  EXPECT_GT(rotation_nees / kRuns, 0.3);
  EXPECT_LT(rotation_nees / kRuns, 2.0);
  EXPECT_GT(direction_nees / kRuns, 0.2);
  EXPECT_LT(direction_nees / kRuns, 2.5);
}

TEST(RelativeMotion, IsTheSameEachTimeAndTurnsWithTheAxes) {
  const Scene scene = make_scene({0.02, -0.05, 0.03}, {0.3, 0.0, 0.1}, false, 0.1, 5);
  RelativeMotionEstimator estimator, other;
  const RelativeMotion first = estimator.estimate(scene.pairs, kSigma, std::nullopt);
  estimator.estimate(make_scene({0, 0, 0}, {1, 0, 0}, false, 0.5, 6).pairs, kSigma, std::nullopt);
  const RelativeMotion again = estimator.estimate(scene.pairs, kSigma, std::nullopt);
  EXPECT_EQ(first.earlier_from_later, again.earlier_from_later);
  EXPECT_EQ(first.direction, again.direction);
  const Matrix3d turned = exp_rotation({0.3, 1.0, -0.5}).toRotationMatrix();
  std::vector<RayPair> pairs = scene.pairs;
  for (RayPair& p : pairs) p = {turned * p.earlier, turned * p.later};
  const RelativeMotion motion = other.estimate(pairs, kSigma, std::nullopt);
  EXPECT_LT((motion.direction - turned * first.direction).norm(), 0.01);
}

TEST(RelativeMotion, TooFewOrSenselessPointsGiveNothing) {
  RelativeMotionEstimator estimator;
  EXPECT_EQ(estimator.estimate({}, kSigma, std::nullopt).model, MotionModel::kNone);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<RayPair> pairs;
  for (int i = 0; i < 60; ++i) {
    pairs.push_back({Vector3d(normal(random), normal(random), 2.0).normalized(),
                     Vector3d(normal(random), normal(random), 2.0).normalized()});
  }
  EXPECT_EQ(estimator.estimate(pairs, kSigma, std::nullopt).model, MotionModel::kNone);
}

}  // namespace
}  // namespace vpdr::vision
