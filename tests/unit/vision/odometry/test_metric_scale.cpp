#include <gtest/gtest.h>

#include <random>

#include "vision/core/odometry/metric_scale.hpp"

namespace vpdr::vision {
namespace {

using Eigen::Vector3d;

constexpr double kUnit = 0.4;    // metres
constexpr double kHeight = 1.6;  // metres
const Vector3d kUp = -Vector3d::UnitY();

/// The camera looks along z at the origin, in units of the map.
struct World {
  std::vector<Landmark> landmarks;
  FeatureTracks frame;
  void add(const Vector3d& metres) {
    const Vector3d p = metres / kUnit;
    const FeatureId id = landmarks.size() + 1;
    const double rho = 1.0 / p.norm();
    landmarks.push_back({id, Vector3d::Zero(), p.normalized(), rho, std::pow(0.05 * rho, 2), 0});
    TrackedFeature f;
    f.id = id;
    f.ray = p.normalized();
    frame.features.push_back(f);
  }
};

/// Floor on the way ahead, walls on both sides with a skirting board's upper edge.
World corridor(bool with_floor) {
  World world;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> depth(2.5, 6.0), side(-0.5, 0.5), up(-0.5, 1.4);
  for (int i = 0; i < 12 && with_floor; ++i) world.add({side(random), kHeight, depth(random)});
  for (int i = 0; i < 30; ++i) {
    const double wall = i % 2 ? 1.2 : -1.2;
    world.add({wall, i % 3 ? kHeight - 0.11 : up(random), depth(random)});
  }
  return world;
}

MetricScaleConfig config() {
  MetricScaleConfig c;
  c.camera_height_m = kHeight;
  return c;
}

TEST(MetricScale, TheFloorOnTheWayAheadGivesTheUnitNotTheSkirting) {
  const World world = corridor(true);
  MetricScale scale(config());
  EXPECT_FALSE(scale.metres());
  scale.look(world.landmarks, world.frame, {}, kUp, 0.005);
  ASSERT_TRUE(scale.metres());
  EXPECT_NEAR(*scale.metres(), kUnit, 0.015 * kUnit);
  EXPECT_LT(scale.sigma_share(), 0.1);
}

TEST(MetricScale, ATiltedVerticalLiftsTheFloorAndIsFound) {
  World world;
  std::mt19937 random(4);
  std::uniform_real_distribution<double> depth(1.5, 8.0), side(-0.3, 0.3);
  for (int i = 0; i < 60; ++i) world.add({side(random), kHeight, depth(random)});
  const double tilt = 0.02;  // rad: at 3 heights' distance the floor stands 6 % higher
  const Vector3d up = (kUp + tilt * Vector3d::UnitZ()).normalized();
  MetricScale scale(config());
  const auto tilted = scale.floor_height(world.landmarks, world.frame, {}, up, 0.02);
  ASSERT_TRUE(tilted);
  EXPECT_NEAR(tilted->height * kUnit, kHeight, 0.015 * kHeight);
  // Held to a vertical that is said to be sure, the mean point tells: 4.75 m ahead, 6 % too high.
  const auto sure = scale.floor_height(world.landmarks, world.frame, {}, up, 1e-4);
  ASSERT_TRUE(sure);
  EXPECT_GT(std::abs(sure->height * kUnit - kHeight), 0.03 * kHeight);
}

TEST(MetricScale, NoFloorNoUnit) {
  const World world = corridor(false);
  MetricScale scale(config());
  scale.look(world.landmarks, world.frame, {}, kUp, 0.005);
  EXPECT_FALSE(scale.metres());
  MetricScale unknown_height{MetricScaleConfig{}};
  unknown_height.look(corridor(true).landmarks, world.frame, {}, kUp, 0.005);
  EXPECT_FALSE(unknown_height.metres());
}

void walk(MetricScale& scale, double metres_a_second) {
  StepEvent step;
  for (int i = 0; i <= 80; ++i) {
    const TimestampNs now = to_ns(0.05 * i);
    if (i % 10 == 5) {
      step.stamp_ns = now - to_ns(0.012);
      step.length_m = 0.7;
      scale.add(step);
    }
    scale.follow(now, Vector3d(0, 0, 0.05 * i * metres_a_second / kUnit));
  }
}

TEST(MetricScale, StepsGiveTheUnitWhereTheFloorDoesNot) {
  MetricScale scale(config());
  walk(scale, 1.4);  // two steps a second
  ASSERT_TRUE(scale.metres());
  EXPECT_NEAR(*scale.metres(), kUnit, 1e-6);
  EXPECT_GT(scale.step_looks(), 0U);
}

TEST(MetricScale, RefusesWhatDoesNotFitUntilItKeepsComing) {
  World world = corridor(true);
  MetricScale scale(config());
  for (int i = 0; i < 10; ++i) scale.look(world.landmarks, world.frame, {}, kUp, 0.005);
  const double before = *scale.metres();
  for (Landmark& l : world.landmarks) l.inverse_distance *= 2.0;
  scale.look(world.landmarks, world.frame, {}, kUp, 0.005);
  EXPECT_EQ(*scale.metres(), before);
  EXPECT_EQ(scale.refused(), 1U);
  for (int i = 0; i < 10; ++i) scale.look(world.landmarks, world.frame, {}, kUp, 0.005);
  EXPECT_NEAR(*scale.metres(), 2.0 * before, 0.05 * before);
}

TEST(MetricScale, TheUnitGetsLessCertainAlongTheWay) {
  const World world = corridor(true);
  MetricScale scale(config());
  scale.look(world.landmarks, world.frame, {}, kUp, 0.005);
  const double before = scale.sigma_share();
  scale.wander(10.0 / kUnit);
  EXPECT_NEAR(scale.sigma_share(), std::hypot(before, 0.03 * std::sqrt(10.0)), 1e-3);
  scale.restart();
  EXPECT_FALSE(scale.metres());
}

}  // namespace
}  // namespace vpdr::vision
