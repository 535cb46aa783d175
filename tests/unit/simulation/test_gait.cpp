#include <gtest/gtest.h>

#include <cmath>

#include "simulation/gait.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector3d;

Walker regular_walker() {
  Walker walker;
  walker.step_length_noise = walker.step_time_noise = 0.0;
  walker.step_length_drift = walker.cadence_drift = 0.0;
  walker.lateral_wander_m = 0.0;
  return walker;
}

Pauses no_stops() {
  Pauses pauses;
  pauses.stop_every_s = 0.0;
  return pauses;
}

TEST(Gait, StepsFollowTheWalkRatio) {
  Walker walker = regular_walker();
  walker.preferred_speed_mps = 1.3;
  const WalkingPath path({{0.0, 0.0}, {40.0, 0.0}});
  const GaitPlan plan = plan_gait(path, Ground(), walker, no_stops(), 60.0, Random(1, "gait"));
  // c = sqrt(60 * 1.3 / 0.0065) = 109.545 steps/min, L = 0.0065 c = 0.712 m, T = 0.5477 s.
  const GaitKnot& middle = plan.knots[30];
  EXPECT_NEAR(middle.step_length_m, 0.7120, 1e-4);
  EXPECT_NEAR(middle.t_s - plan.knots[29].t_s, 0.54772, 1e-5);
}

TEST(Gait, StepsAddUpToTheWay) {
  const WalkingPath path({{0.0, 0.0}, {12.0, 0.0}, {12.0, 9.0}, {3.0, 9.0}});
  const GaitPlan plan = plan_gait(path, Ground(), {}, {}, 60.0, Random(4, "gait"));
  ASSERT_TRUE(plan.reached_end);
  double sum = 0.0;
  for (const TrueStep& step : true_steps(plan, 0)) sum += step.length_m;
  EXPECT_NEAR(sum, path.length_m(), 1e-9);
}

TEST(Gait, SlowsInTurnsByTheCubeRootOfCurvature) {
  const WalkingPath path({{0.0, 0.0}, {15.0, 0.0}, {15.0, 15.0}});
  const GaitPlan plan =
      plan_gait(path, Ground(), regular_walker(), no_stops(), 60.0, Random(1, "gait"));
  double slowest = 9.0, fastest = 0.0;
  for (std::size_t i = 5; i + 5 < plan.knots.size(); ++i) {
    const double speed = plan.knots[i].step_length_m / (plan.knots[i].t_s - plan.knots[i - 1].t_s);
    slowest = std::min(slowest, speed);
    fastest = std::max(fastest, speed);
  }
  EXPECT_NEAR(fastest, 1.36, 0.01);
  // Curvature at the apex is 1.875 * (pi / 2) / 2.6 = 1.133 / m: (1 + 3.776^2)^(-1/6) = 0.635.
  EXPECT_NEAR(slowest, 0.635 * 1.36, 0.04);
}

TEST(Gait, ComesToAStandWhenTimeIsUp) {
  const WalkingPath path({{0.0, 0.0}, {500.0, 0.0}});
  const GaitPlan plan = plan_gait(path, Ground(), {}, {}, 30.0, Random(1, "gait"));
  EXPECT_FALSE(plan.reached_end);
  EXPECT_LT(plan.end_of_walk_s, 28.0 + 0.2);
  EXPECT_GT(plan.end_of_walk_s, 26.0);
}

TEST(Gait, StopsOnTheWay) {
  Pauses pauses;
  pauses.stop_every_s = 20.0;
  pauses.stop_s = 4.0;
  const WalkingPath path({{0.0, 0.0}, {100.0, 0.0}});
  const GaitPlan plan = plan_gait(path, Ground(), {}, pauses, 120.0, Random(1, "gait"));
  int stops = 0;
  for (std::size_t i = 3; i < plan.knots.size(); ++i) {
    const GaitKnot &a = plan.knots[i - 1], &b = plan.knots[i];
    if (b.t_s - a.t_s > 3.5) ++stops;
    EXPECT_GT(b.t_s, a.t_s);
    EXPECT_GE(b.progress_m, a.progress_m);
  }
  EXPECT_GE(stops, 3);
  EXPECT_LE(stops, 6);
}

/// Peak of the norm of specific force around each step in mid-walk, averaged.
double mean_peak(WornAt worn) {
  const WalkingPath path({{0.0, 0.0}, {40.0, 0.0}});
  const Walker walker = regular_walker();
  const GaitPlan plan = plan_gait(path, Ground(), walker, no_stops(), 40.0, Random(1, "gait"));
  const MotionSpline motion =
      move_board(path, Ground(), plan, walker, worn, 40.0, Random(1, "body"));
  double sum = 0.0;
  int steps = 0;
  for (std::size_t i = 10; i + 10 < plan.knots.size(); ++i, ++steps) {
    double peak = 0.0;
    for (double t = plan.knots[i].t_s - 0.1; t < plan.knots[i].t_s + 0.35; t += 0.005) {
      peak = std::max(peak, motion.at(t).specific_force_mps2().norm());
    }
    sum += peak;
  }
  return sum / steps;
}

TEST(BoardMotion, PeaksAreThoseOfRealWalks) {
  const double head = mean_peak(WornAt::kHead), chest = mean_peak(WornAt::kChest),
               waist = mean_peak(WornAt::kWaist);
  // Recorded: waist 13 to 16, chest 15 to 17 m/s^2; the head is held stiller.
  EXPECT_GT(head, 12.5);
  EXPECT_LT(head, 15.0);
  EXPECT_GT(chest, head);
  EXPECT_LT(chest, 17.0);
  EXPECT_GT(waist, head);
  EXPECT_LT(waist, 18.0);
}

TEST(BoardMotion, BounceIsAboutHalfThePendulums) {
  const WalkingPath path({{0.0, 0.0}, {40.0, 0.0}});
  const Walker walker = regular_walker();
  const GaitPlan plan = plan_gait(path, Ground(), walker, no_stops(), 40.0, Random(1, "gait"));
  const MotionSpline motion =
      move_board(path, Ground(), plan, walker, WornAt::kHead, 40.0, Random(1, "body"));
  double low = 9.0, high = 0.0;
  for (double t = 12.0; t < 16.0; t += 0.005) {
    low = std::min(low, motion.at(t).position_m.z());
    high = std::max(high, motion.at(t).position_m.z());
  }
  // Leg 0.912 m, step 0.728 m: pendulum 0.912 - sqrt(0.912^2 - 0.364^2) = 75.8 mm.
  EXPECT_GT(high - low, 0.030);
  EXPECT_LT(high - low, 0.055);
}

TEST(BoardMotion, TheBoardFollowsThePathAndLooksAlongIt) {
  const WalkingPath path({{0.0, 0.0}, {0.0, 30.0}});
  const GaitPlan plan =
      plan_gait(path, Ground(), regular_walker(), no_stops(), 40.0, Random(1, "gait"));
  const MotionSpline motion =
      move_board(path, Ground(), plan, regular_walker(), WornAt::kHead, 40.0, Random(1, "body"));
  for (const GaitKnot& knot : plan.knots) {
    const MotionState state = motion.at(knot.t_s);
    EXPECT_NEAR(state.position_m.x(), 0.0, 0.06);
    EXPECT_NEAR(state.position_m.y(), knot.progress_m + 0.1, 0.06);
    const Vector3d forward = state.world_from_body * Vector3d::UnitX();
    EXPECT_GT(forward.y(), 0.97);
  }
}

TEST(Walker, DrawnWalkersSpreadAroundTheMean) {
  Random random(1, "walkers");
  double height = 0.0, squares = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Walker walker = draw_walker(random);
    height += walker.height_m / 2000;
    squares += std::pow(walker.height_m - 1.72, 2) / 2000;
  }
  EXPECT_NEAR(height, 1.72, 0.01);
  EXPECT_NEAR(std::sqrt(squares), 0.09, 0.01);
}

}  // namespace
}  // namespace vpdr::simulation
