#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "simulation/curve.hpp"

namespace vpdr::simulation {
namespace {

using Eigen::Vector3d;

TEST(MonotoneCurve, MeetsItsKnotsAndNeverTurnsBack) {
  const MonotoneCurve curve({0.0, 1.0, 1.5, 4.0, 5.0}, {0.0, 0.0, 2.0, 2.5, 2.5});
  EXPECT_DOUBLE_EQ(curve(1.0), 0.0);
  EXPECT_DOUBLE_EQ(curve(1.5), 2.0);
  EXPECT_DOUBLE_EQ(curve(-3.0), 0.0);
  EXPECT_DOUBLE_EQ(curve(9.0), 2.5);
  for (double x = 0.0; x < 5.0; x += 0.01) EXPECT_LE(curve(x), curve(x + 0.01) + 1e-12);
}

TEST(MonotoneCurve, IsStraightThroughKnotsOnALine) {
  const MonotoneCurve curve({0.0, 1.0, 2.0, 3.0}, {1.0, 3.0, 5.0, 7.0});
  // Half-way between inner knots with the true slope on both sides.
  EXPECT_NEAR(curve(1.5), 4.0, 1e-12);
}

TEST(MonotoneCurve, RefusesTooFewKnots) {
  EXPECT_THROW(MonotoneCurve({0.0}, {0.0}), std::invalid_argument);
}

MotionSpline wavy_motion() {
  std::vector<MotionSpline::Control> controls;
  for (int k = 0; k < 2003; ++k) {
    const double t = (k - 1) * 0.005;
    MotionSpline::Control c;
    c << 1.3 * t, 0.4 * std::sin(1.1 * t), 1.6 + 0.02 * std::cos(11.0 * t), 0.1 * std::sin(3.0 * t),
        0.2 * std::cos(2.0 * t), 0.9 * t + 0.3 * std::sin(4.0 * t);
    controls.push_back(c);
  }
  return {0.005, controls};
}

TEST(MotionSpline, AStraightLineOfControlsIsReproduced) {
  std::vector<MotionSpline::Control> controls;
  for (int k = 0; k < 10; ++k) {
    MotionSpline::Control c = MotionSpline::Control::Zero();
    c[0] = 2.0 * (k - 1);  // 2 m each 0.5 s
    controls.push_back(c);
  }
  const MotionSpline motion(0.5, controls);
  EXPECT_DOUBLE_EQ(motion.duration_s(), 3.5);
  const MotionState state = motion.at(1.3);
  EXPECT_NEAR(state.position_m.x(), 5.2, 1e-12);
  EXPECT_NEAR(state.velocity_mps.x(), 4.0, 1e-12);
  EXPECT_NEAR(state.acceleration_mps2.norm(), 0.0, 1e-12);
  EXPECT_TRUE(state.specific_force_mps2().isApprox(Vector3d(0.0, 0.0, kGravityMps2)));
}

TEST(MotionSpline, AccelerationIntegratesTwiceToPosition) {
  const MotionSpline motion = wavy_motion();
  MotionState before = motion.at(0.0);
  Vector3d velocity = before.velocity_mps, position = before.position_m;
  // Acceleration is linear between controls: the trapezium and its cubic are exact there.
  for (int k = 1; k <= 2000; ++k) {
    const MotionState now = motion.at(k * 0.005);
    const double h = 0.005;
    position +=
        h * velocity + h * h * (before.acceleration_mps2 / 3.0 + now.acceleration_mps2 / 6.0);
    velocity += 0.5 * h * (before.acceleration_mps2 + now.acceleration_mps2);
    before = now;
  }
  EXPECT_NEAR((position - before.position_m).norm(), 0.0, 1e-9);
  EXPECT_NEAR((velocity - before.velocity_mps).norm(), 0.0, 1e-9);
}

TEST(MotionSpline, AngularVelocityIntegratesToAttitude) {
  const MotionSpline motion = wavy_motion();
  Eigen::Quaterniond q = motion.at(0.0).world_from_body;
  const double h = 0.001;
  for (double t = 0.0; t < 9.9995; t += h) {
    q = q * exp_rotation(h * motion.at(t + 0.5 * h).angular_velocity_radps);  // midpoint rule
  }
  EXPECT_LT(log_rotation(motion.at(10.0).world_from_body.conjugate() * q).norm(), 1e-5);
}

TEST(MotionSpline, PositionIsTwiceContinuouslyDifferentiable) {
  const MotionSpline motion = wavy_motion();
  for (int k = 1; k < 1999; k += 13) {
    const MotionState left = motion.at(k * 0.005 - 1e-9), right = motion.at(k * 0.005 + 1e-9);
    EXPECT_LT((left.acceleration_mps2 - right.acceleration_mps2).norm(), 1e-4);
    EXPECT_LT((left.velocity_mps - right.velocity_mps).norm(), 1e-7);
  }
}

}  // namespace
}  // namespace vpdr::simulation
