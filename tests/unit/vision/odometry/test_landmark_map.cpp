#include <gtest/gtest.h>

#include <random>

#include "core/rotation.hpp"
#include "vision/core/odometry/landmark_map.hpp"

namespace vpdr::vision {
namespace {

using Eigen::Vector3d;

/// A hundred points 2 to 8 units ahead.
std::vector<Vector3d> points() {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> side(-0.6, 0.6), depth(2.0, 8.0);
  std::vector<Vector3d> out;
  for (int i = 0; i < 100; ++i) {
    const double z = depth(random);
    out.emplace_back(side(random) * z, side(random) * z, z);
  }
  return out;
}

FeatureTracks seen_from(const CameraPose& pose, double sigma = 0.0, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  FeatureTracks frame;
  FeatureId id = 0;
  for (const Vector3d& p : points()) {
    TrackedFeature f;
    f.id = ++id;
    f.ray = (pose.map_from_camera.conjugate() * (p - pose.position)).normalized();
    f.ray = (f.ray + sigma * Vector3d(normal(random), normal(random), normal(random))).normalized();
    frame.features.push_back(f);
  }
  return frame;
}

LandmarkMap map_with(double wrong_share, double variance) {
  LandmarkMap map;
  FeatureId id = 0;
  for (const Vector3d& p : points()) {
    const double rho = 1.0 / p.norm();
    map.add({++id, Vector3d::Zero(), p.normalized(), rho * (1.0 + (id % 2 ? 1 : -1) * wrong_share),
             variance, 0});
  }
  return map;
}

const CameraPose kPose{{0.3, -0.1, 0.4}, exp_rotation({0.05, -0.1, 0.02})};

TEST(Sighting, HasTheDerivativesOfItsError) {
  Landmark l{1, {0.1, 0.2, -0.1}, Vector3d(0.1, -0.2, 1.0).normalized(), 0.3, 0.01, 0};
  const Vector3d ray = Vector3d(0.05, -0.25, 1.0).normalized();
  const Sighting s = sight(l, ray, kPose);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 6; ++i) {
    CameraPose moved = kPose;
    if (i < 3) {
      moved.position(i) += kStep;
    } else {
      moved.map_from_camera = moved.map_from_camera * exp_rotation(Vector3d::Unit(i - 3) * kStep);
    }
    const Eigen::Vector2d slope = (sight(l, ray, moved).error - s.error) / kStep;
    EXPECT_LT((slope - s.by_pose.col(i)).norm(), 1e-5) << i;
  }
  Landmark nearer = l;
  nearer.inverse_distance += kStep;
  EXPECT_LT(((sight(nearer, ray, kPose).error - s.error) / kStep - s.by_inverse_distance).norm(),
            1e-5);
}

TEST(PoseFix, FindsThePoseAmongKnownPoints) {
  const LandmarkMap map = map_with(0.0, 1e-8);
  FeatureTracks frame = seen_from(kPose);
  for (std::size_t i = 0; i < 20; ++i) {  // a fifth of the points is wrong
    frame.features[5 * i].ray = Vector3d(0.3, 0.1 * static_cast<double>(i % 3), 1.0).normalized();
  }
  const PosePrior prior{{Vector3d::Zero(), Eigen::Quaterniond::Identity()}, 0.3, 1.0};
  const PoseFix fix = fix_pose(map.landmarks(), frame, prior, 1e-3);
  EXPECT_LT((fix.pose.position - kPose.position).norm(), 2e-3);
  EXPECT_LT(fix.pose.map_from_camera.angularDistance(kPose.map_from_camera), 1e-3);
  EXPECT_GE(fix.inliers, 80U);
  EXPECT_EQ(fix.seen, 100U);
}

TEST(PoseFix, PointsOfUnknownDistanceStillGiveTheRotation) {
  const LandmarkMap map = map_with(0.0, 1.0);
  const CameraPose turned{Vector3d::Zero(), exp_rotation({0.1, 0.2, -0.1})};
  const PosePrior prior{{Vector3d::Zero(), Eigen::Quaterniond::Identity()}, 0.5, 0.01};
  const PoseFix fix = fix_pose(map.landmarks(), seen_from(turned), prior, 1e-3);
  EXPECT_LT(fix.pose.map_from_camera.angularDistance(turned.map_from_camera), 1e-3);
}

TEST(LandmarkMap, KeyFramesNarrowTheDistances) {
  LandmarkMap map = map_with(0.3, 0.01);
  for (int i = 1; i <= 6; ++i) {
    const CameraPose pose{{0.1 * i, 0.0, 0.05 * i}, Eigen::Quaterniond::Identity()};
    map.update(seen_from(pose, 5e-4, static_cast<unsigned>(i)), pose, 7e-4, 0.0);
  }
  const auto truth = points();
  double worst = 0.0, sum = 0.0;
  for (const Landmark& l : map.landmarks()) {
    const double off = std::abs(l.inverse_distance * truth[l.id - 1].norm() - 1.0);
    worst = std::max(worst, off / l.relative_sigma());
    sum += off;
  }
  EXPECT_LT(sum / 100.0, 0.02);
  EXPECT_LT(worst, 5.0);
}

TEST(LandmarkMap, DropsWhatIsGoneAndTakesInWhatIsNew) {
  LandmarkMap map = map_with(0.0, 1e-4);
  FeatureTracks frame = seen_from(kPose);
  frame.features.erase(frame.features.begin(), frame.features.begin() + 10);
  TrackedFeature fresh;
  fresh.id = 500;
  fresh.ray = Vector3d::UnitZ();
  frame.features.push_back(fresh);
  map.update(frame, kPose, 1e-3, 0.0);
  ASSERT_EQ(map.landmarks().size(), 91U);
  EXPECT_EQ(map.landmarks().front().id, 11U);
  const Landmark& taken = map.landmarks().back();
  EXPECT_EQ(taken.id, 500U);
  EXPECT_EQ(taken.anchor, kPose.position);
  EXPECT_GT(taken.relative_sigma(), 0.5);
}

}  // namespace
}  // namespace vpdr::vision
