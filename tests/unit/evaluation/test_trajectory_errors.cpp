#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/rotation.hpp"
#include "evaluation/trajectory_errors.hpp"

namespace vpdr::evaluation {
namespace {

std::vector<PositionPair> random_walk_pairs(unsigned seed, const YawAlignment& truth_from_estimate,
                                            double noise_m) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<PositionPair> pairs;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (int i = 0; i < 200; ++i) {
    place += Eigen::Vector3d(normal(random), normal(random), 0.1 * normal(random));
    const Eigen::Vector3d noise(normal(random), normal(random), normal(random));
    pairs.push_back({i, place, truth_from_estimate.apply(place) + noise_m * noise});
  }
  return pairs;
}

TEST(AlignYaw, FindsTheRotationAndTranslation) {
  const YawAlignment known{2.5, {10.0, -20.0, 3.0}};
  const YawAlignment found = align_yaw(random_walk_pairs(1, known, 0.0));
  EXPECT_NEAR(found.yaw_rad, known.yaw_rad, 1e-12);
  EXPECT_TRUE(found.translation_m.isApprox(known.translation_m, 1e-9));
}

TEST(AlignYaw, NoOtherYawFitsBetter) {
  const auto pairs = random_walk_pairs(2, {-1.0, {1.0, 2.0, 3.0}}, 2.0);
  const auto cost = [&](const YawAlignment& alignment) {
    double sum = 0.0;
    for (const auto& pair : pairs) {
      sum += (alignment.apply(pair.estimate_m) - pair.truth_m).squaredNorm();
    }
    return sum;
  };
  const YawAlignment best = align_yaw(pairs);
  for (const double delta : {-0.1, -0.001, 0.001, 0.1}) {
    YawAlignment other = best;
    other.yaw_rad += delta;
    EXPECT_GT(cost(other), cost(best));
    other = best;
    other.translation_m.x() += delta;
    EXPECT_GT(cost(other), cost(best));
  }
}

/// The truth walks 20 m east in 20 s, a pose every 0.1 s; the estimate is f(truth place).
struct Scene {
  dataset::Truth truth;
  RunDirectory run;
};
template <class Estimate>
Scene scene(Estimate estimate_of) {
  Scene s;
  for (int i = 0; i <= 200; ++i) {
    const TimestampNs stamp = i * kNsPerSecond / 10;
    const Eigen::Vector3d place(i / 10.0, 0.0, 1.0);
    s.truth.poses.push_back({stamp, place, Eigen::Quaterniond::Identity()});
    s.run.fused.push_back({stamp, estimate_of(place), Eigen::Quaterniond::Identity()});
  }
  return s;
}

TEST(PositionErrors, AShortScaleShowsInEveryFigure) {
  // Steps 10 % short, started elsewhere: after alignment at the centre the error grows linearly to
  // 1 m at both ends, so its RMS is 1/sqrt(3) (with 201 rows, sqrt(101/300)); each 10 m segment
  // misses 1 m; from the start the error ends at 2 m of 20 m, with mean 1 m.
  const Scene s =
      scene([](const Eigen::Vector3d& p) { return Eigen::Vector3d(0.9 * p.x() + 7.0, 5.0, 1.0); });
  const auto errors = position_errors(s.run, s.truth);
  ASSERT_TRUE(errors.has_value());
  EXPECT_NEAR(errors->path_m, 20.0, 1e-9);
  EXPECT_NEAR(errors->ate_m, std::sqrt(101.0 / 300.0), 1e-9);
  EXPECT_NEAR(*errors->rpe_percent, 10.0, 1e-6);
  EXPECT_DOUBLE_EQ(errors->segment_m, 10.0);
  EXPECT_NEAR(errors->start_aligned.mean_m, 1.0, 1e-9);
  EXPECT_NEAR(errors->start_aligned.max_m, 2.0, 1e-9);
  EXPECT_NEAR(errors->start_aligned.final_m, 2.0, 1e-9);
  EXPECT_NEAR(errors->start_aligned.final_percent, 10.0, 1e-9);
  EXPECT_FALSE(errors->inside_95_percent.has_value());
}

TEST(PositionErrors, AYawOffsetShowsFromTheStartOnly) {
  const double yaw = to_radians(60.0);
  const Scene s = scene([&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d(std::cos(yaw) * p.x(), std::sin(yaw) * p.x(), 4.0);
  });
  const auto errors = position_errors(s.run, s.truth);
  EXPECT_NEAR(errors->ate_m, 0.0, 1e-9);
  EXPECT_NEAR(*errors->rpe_percent, 0.0, 1e-9);
  EXPECT_NEAR(errors->start_aligned.final_m, 20.0, 1e-9);  // an equilateral triangle
}

TEST(PositionErrors, ShareInsideTheEllipseUsesItsDirection) {
  // The error is 0.1 m a metre along x; sigma_x = 0.5 m, sigma_y tiny. Inside while
  // 0.1 s <= 0.5 sqrt(5.991) = 1.2239 m, so for s <= 12.239 m: rows 0..122 of 201.
  Scene s = scene([](const Eigen::Vector3d& p) { return Eigen::Vector3d(1.1 * p.x(), 0.0, 1.0); });
  StampedCovariance covariance;
  covariance.position_m2 << 0.25, 0.0, 0.0, 1e-8;
  for (const auto& pose : s.run.fused) {
    covariance.stamp_ns = pose.stamp_ns;
    s.run.covariance.push_back(covariance);
  }
  EXPECT_NEAR(*position_errors(s.run, s.truth)->inside_95_percent, 100.0 * 123 / 201, 1e-9);
  for (auto& row : s.run.covariance) row.position_m2 << 1e-8, 0.0, 0.0, 0.25;
  EXPECT_LT(*position_errors(s.run, s.truth)->inside_95_percent, 2.0);
}

TEST(PositionErrors, ComparesOnlyWhereBothAreKnown) {
  Scene s = scene([](const Eigen::Vector3d& p) { return p; });
  s.run.fused.erase(s.run.fused.begin(), s.run.fused.begin() + 50);
  s.run.fused.resize(100);
  s.truth.poses[60].position_m.setConstant(std::numeric_limits<double>::quiet_NaN());
  const auto errors = position_errors(s.run, s.truth);
  EXPECT_EQ(errors->poses, 99U);
  EXPECT_NEAR(errors->ate_m, 0.0, 1e-9);
  EXPECT_NEAR(errors->path_m, 9.9, 1e-9);
}

TEST(PositionErrors, StandingStillHasNoSegmentsAndNoPath) {
  const Scene moving = scene([](const Eigen::Vector3d& p) { return p; });
  Scene still = moving;
  for (auto& pose : still.truth.poses) pose.position_m.setZero();
  const auto errors = position_errors(still.run, still.truth);
  EXPECT_FALSE(errors->rpe_percent.has_value());
  EXPECT_DOUBLE_EQ(errors->path_m, 0.0);
  EXPECT_DOUBLE_EQ(errors->start_aligned.final_percent, 0.0);
  EXPECT_FALSE(position_errors(RunDirectory{}, moving.truth).has_value());
}

}  // namespace
}  // namespace vpdr::evaluation
