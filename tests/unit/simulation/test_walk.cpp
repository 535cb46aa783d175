#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "simulation/walk.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector3d;

WalkOptions short_walk(std::uint64_t seed) {
  WalkOptions options;
  options.seed = seed;
  options.duration_s = 30.0;
  return options;
}

TEST(SimulatedWalk, AtRestReadsGravityAndNoTurn) {
  WalkOptions options = short_walk(1);
  options.errors = SensorErrors::none();
  const SimulatedWalk walk = simulate_walk(options);
  Vector3d force = Vector3d::Zero(), rate = Vector3d::Zero();
  for (int i = 0; i < 500; ++i) {  // 2.5 s of standing
    force += walk.imu[static_cast<std::size_t>(i)].specific_force_mps2 / 500;
    rate += walk.imu[static_cast<std::size_t>(i)].angular_velocity_radps / 500;
    EXPECT_NEAR(walk.imu[static_cast<std::size_t>(i)].specific_force_mps2.norm(), kGravityMps2,
                0.15);
  }
  EXPECT_NEAR(force.norm(), kGravityMps2, 0.02);
  EXPECT_LT(rate.norm(), 0.015);
}

TEST(SimulatedWalk, WithoutErrorsTheGyroscopeIntegratesToTheTruth) {
  WalkOptions options = short_walk(2);
  options.errors = SensorErrors::none();
  const SimulatedWalk walk = simulate_walk(options);
  Eigen::Quaterniond q = walk.state_at(walk.imu.front().stamp_ns).world_from_body;
  for (std::size_t i = 1; i < walk.imu.size(); ++i) {
    const double h = to_seconds(walk.imu[i].stamp_ns - walk.imu[i - 1].stamp_ns);
    q = q *
        exp_rotation(0.5 * h *
                     (walk.imu[i - 1].angular_velocity_radps + walk.imu[i].angular_velocity_radps));
  }
  const auto truth = walk.state_at(walk.imu.back().stamp_ns).world_from_body;
  EXPECT_LT(to_degrees(log_rotation(truth.conjugate() * q).norm()), 0.05);
}

TEST(SimulatedWalk, WithoutErrorsTheAccelerometerIntegratesTwiceToTheTruth) {
  WalkOptions options = short_walk(3);
  options.errors = SensorErrors::none();
  const SimulatedWalk walk = simulate_walk(options);
  const MotionState start = walk.state_at(walk.imu.front().stamp_ns);
  Vector3d position = start.position_m, velocity = start.velocity_mps;
  const auto acceleration = [&](std::size_t i) -> Vector3d {
    const auto q = walk.state_at(walk.imu[i].stamp_ns).world_from_body;
    return q * walk.imu[i].specific_force_mps2 - Vector3d(0.0, 0.0, kGravityMps2);
  };
  for (std::size_t i = 1; i < walk.imu.size(); ++i) {
    const double h = to_seconds(walk.imu[i].stamp_ns - walk.imu[i - 1].stamp_ns);
    const Vector3d before = acceleration(i - 1), after = acceleration(i);
    position += h * velocity + h * h * (before / 3.0 + after / 6.0);
    velocity += 0.5 * h * (before + after);
  }
  const MotionState end = walk.state_at(walk.imu.back().stamp_ns);
  EXPECT_LT((position - end.position_m).norm(), 1e-6);
  EXPECT_LT((velocity - end.velocity_mps).norm(), 1e-6);
}

TEST(SimulatedWalk, TheSeedDecidesEverySample) {
  const SimulatedWalk a = simulate_walk(short_walk(4)), b = simulate_walk(short_walk(4)),
                      c = simulate_walk(short_walk(5));
  ASSERT_EQ(a.imu.size(), b.imu.size());
  bool differs = false;
  for (std::size_t i = 0; i < a.imu.size(); ++i) {
    ASSERT_EQ(a.imu[i].stamp_ns, b.imu[i].stamp_ns);
    ASSERT_EQ(a.imu[i].specific_force_mps2, b.imu[i].specific_force_mps2);
    ASSERT_EQ(a.imu[i].angular_velocity_radps, b.imu[i].angular_velocity_radps);
    differs = differs || a.imu[i].specific_force_mps2 != c.imu[i].specific_force_mps2;
  }
  for (std::size_t i = 0; i < a.mag.size(); ++i) ASSERT_EQ(a.mag[i].field_ut, b.mag[i].field_ut);
  EXPECT_EQ(a.pressure.back().pressure_pa, b.pressure.back().pressure_pa);
  EXPECT_TRUE(differs);
  EXPECT_NE(a.corners_m, c.corners_m);
}

TEST(SimulatedWalk, OneSensorsErrorsLeaveTheOthersAlone) {
  WalkOptions quiet = short_walk(4);
  quiet.errors.gyroscope = TriadErrors{};
  quiet.camera_rate_hz = 30.0;
  const SimulatedWalk a = simulate_walk(short_walk(4)), b = simulate_walk(quiet);
  EXPECT_NE(a.imu.back().angular_velocity_radps, b.imu.back().angular_velocity_radps);
  EXPECT_EQ(a.imu.back().specific_force_mps2, b.imu.back().specific_force_mps2);
  EXPECT_EQ(a.mag.back().field_ut, b.mag.back().field_ut);
}

TEST(SimulatedWalk, RatesAndStampsAreThoseAskedFor) {
  WalkOptions options = short_walk(6);
  options.imu_rate_hz = 20.0;
  options.mag_rate_hz = 0.0;
  options.pressure_rate_hz = 10.0;
  options.stamp_jitter_s = 0.002;
  const SimulatedWalk walk = simulate_walk(options);
  EXPECT_EQ(walk.imu.size(), 600u);
  EXPECT_TRUE(walk.mag.empty());
  EXPECT_EQ(walk.pressure.size(), 300u);
  EXPECT_EQ(walk.frames.size(), 300u);
  EXPECT_EQ(walk.imu.front().stamp_ns, options.start_ns);
  bool irregular = false;
  for (std::size_t i = 1; i < walk.imu.size(); ++i) {
    const TimestampNs gap = walk.imu[i].stamp_ns - walk.imu[i - 1].stamp_ns;
    EXPECT_GT(gap, 35'000'000);
    irregular = irregular || gap != 50'000'000;
  }
  EXPECT_TRUE(irregular);
}

TEST(SimulatedWalk, MagnetometerReadsTheEarthsFieldWithinTheDisturbance) {
  const SimulatedWalk walk = simulate_walk(short_walk(7));
  double mean = 0.0;
  for (const MagSample& sample : walk.mag) {
    mean += sample.field_ut.norm() / static_cast<double>(walk.mag.size());
    EXPECT_NEAR(sample.field_ut.norm(), 48.0, 14.0);
  }
  EXPECT_NEAR(mean, 48.0, 3.0);
}

/// Property: whatever the seed and the place on the body, the walk is one a person could have done.
class AnyWalk : public testing::TestWithParam<int> {};

TEST_P(AnyWalk, NeverGoesThroughAWall) {
  WalkOptions options = short_walk(static_cast<std::uint64_t>(GetParam()));
  options.duration_s = 60.0;
  options.worn = static_cast<WornAt>(GetParam() % 3);
  options.draw_walker = true;
  options.imu_rate_hz = 50.0;
  const SimulatedWalk walk = simulate_walk(options);
  for (const ImuSample& sample : walk.imu) {
    const Vector3d place = walk.state_at(sample.stamp_ns).position_m;
    ASSERT_GT(walk.plan.clearance_m(place.head<2>()), 0.4);
    ASSERT_GT(place.z(), 0.7);
    ASSERT_LT(place.z(), 2.2);
  }
}

TEST_P(AnyWalk, StepsAreCountedAndAddUpToTheDistanceWalked) {
  const SimulatedWalk walk = simulate_walk(short_walk(static_cast<std::uint64_t>(GetParam())));
  double along = 0.0;
  Vector3d before = walk.state_at(walk.options.start_ns).position_m;
  for (const TrueStep& step : walk.steps) {
    const Vector3d now = walk.state_at(step.stamp_ns).position_m;
    along += (now - before).head<2>().norm();
    before = now;
    EXPECT_GT(step.length_m, 0.2);
    EXPECT_LT(step.length_m, 1.0);
  }
  // Chords from heel strike to heel strike: head sway lengthens them, corners shorten them.
  EXPECT_NEAR(along, walk.distance_m, 0.03 * walk.distance_m + 0.2);
  const double walking_s = to_seconds(walk.steps.back().stamp_ns - walk.options.start_ns) - 3.0;
  EXPECT_NEAR(static_cast<double>(walk.steps.size()) / walking_s, 1.75, 0.25);
}

TEST_P(AnyWalk, BeginsStandingAtTheOriginAndLooksAlongTheWay) {
  const SimulatedWalk walk = simulate_walk(short_walk(static_cast<std::uint64_t>(GetParam())));
  const MotionState start = walk.state_at(walk.options.start_ns);
  EXPECT_LT(start.position_m.head<2>().norm(), 0.5);
  EXPECT_LT(start.velocity_mps.norm(), 0.05);
  const Eigen::Vector2d leg = walk.corners_m[1] - walk.corners_m[0];
  EXPECT_LT(std::abs(wrap_pi(yaw_of(start.world_from_body) - std::atan2(leg.y(), leg.x()))), 0.15);
  EXPECT_GT(to_seconds(walk.steps.front().stamp_ns - walk.options.start_ns), 3.0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AnyWalk, testing::Range(1, 7));

TEST(SimulatedWalk, TheDemoIsATwoMinuteLoopWithTurns) {
  WalkOptions options;
  options.imu_rate_hz = 20.0;  // the way is the same at any rate
  const SimulatedWalk walk = simulate_walk(options);
  EXPECT_GT(walk.distance_m, 115.0);
  EXPECT_LT(walk.distance_m, 150.0);
  EXPECT_GE(walk.corners_m.size(), 8u + 2u);
  EXPECT_LE(walk.corners_m.size(), 10u + 2u);
  const Vector3d end = walk.state_at(options.start_ns + to_ns(options.duration_s)).position_m;
  EXPECT_LT(end.head<2>().norm(), 0.5);
}

TEST(SimulatedWalk, FollowsGivenWaypoints) {
  WalkOptions options = short_walk(8);
  options.waypoints_m = {{2.0, 3.0}, {14.0, 3.0}, {14.0, 9.0}};
  options.walker.lateral_wander_m = 0.0;
  const SimulatedWalk walk = simulate_walk(options);
  const Vector3d end = walk.state_at(options.start_ns + to_ns(30.0)).position_m;
  EXPECT_NEAR(end.x(), 14.0, 0.1);
  EXPECT_NEAR(end.y(), 9.1, 0.1);
}

TEST(SimulatedWalk, TheBodyFacesWhereItGoes) {
  WalkOptions options;
  options.seed = 5;
  options.worn = WornAt::kWaist;
  options.waypoints_m = {{0.0, 0.0}, {60.0, 0.0}};
  options.duration_s = 45.0;
  options.errors = SensorErrors::none();
  const SimulatedWalk walk = simulate_walk(options);
  double squares = 0.0;
  double largest = 0.0;
  std::size_t strides = 0;
  for (std::size_t i = 6; i + 8 < walk.steps.size(); i += 2, ++strides) {
    const TimestampNs begin = walk.steps[i].stamp_ns;
    const TimestampNs end = walk.steps[i + 2].stamp_ns;
    constexpr int kParts = 20;
    double yaw = 0.0;
    for (int k = 0; k < kParts; ++k) {
      yaw += yaw_of(walk.state_at(begin + (end - begin) * k / kParts).world_from_body) / kParts;
    }
    const Vector3d moved = walk.state_at(end).position_m - walk.state_at(begin).position_m;
    const double direction = std::atan2(moved.y(), moved.x());
    squares += (yaw - direction) * (yaw - direction);
    largest = std::max(largest, std::abs(direction));
  }
  ASSERT_GT(strides, 15U);
  EXPECT_LT(to_degrees(std::sqrt(squares / static_cast<double>(strides))), 1.5);
  EXPECT_GT(to_degrees(largest), 3.0) << "the way does stray";
}

TEST(SimulatedWalk, RefusesOptionsThatMakeNoSense) {
  WalkOptions slow = short_walk(1);
  slow.walker.preferred_speed_mps = 0.0;
  EXPECT_THROW(simulate_walk(slow), ConfigurationFault);
  WalkOptions brief = short_walk(1);
  brief.duration_s = 1.0;
  EXPECT_THROW(simulate_walk(brief), ConfigurationFault);
  WalkOptions nan = short_walk(1);
  nan.duration_s = std::nan("");
  EXPECT_THROW(simulate_walk(nan), ConfigurationFault);
}

}  // namespace
}  // namespace vpdr::simulation
