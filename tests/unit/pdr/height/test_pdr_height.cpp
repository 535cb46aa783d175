#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <variant>

#include "core/reading.hpp"
#include "pdr/core/pdr.hpp"
#include "simulation/walk.hpp"
#include "tests/unit/pdr/height/made_air.hpp"
#include "tests/unit/pdr/made_walk.hpp"

namespace vpdr::pdr {
namespace {

constexpr double kWalkSeconds = 110.0;
constexpr double kStairsBegin = 30.0;

/// 1.8 steps/s all the way, standing at first.
made::Readings walking() {
  made::Motion motion;
  motion.upward_mps2 = [](double t) { return t < 2.0 ? 0.0 : made::bounce(1.8)(t - 2.0); };
  return made::read(motion, kWalkSeconds, 100.0);
}

struct Walk {
  std::vector<StepEvent> steps;
  std::vector<PoseEstimate> poses;
};

Walk run(Pdr& pdr, const made::Readings& readings, const std::vector<PressureSample>& pressure) {
  Walk walk;
  PdrOutput output;
  for (const Reading& reading : merge_by_stamp(readings.imu, readings.mag, pressure)) {
    if (const auto* sample = std::get_if<PressureSample>(&reading)) pdr.process(*sample);
    if (const auto* sample = std::get_if<MagSample>(&reading)) pdr.process(*sample);
    const auto* imu = std::get_if<ImuSample>(&reading);
    if (imu == nullptr || pdr.process(*imu, output) != Refusal::kNone) continue;
    walk.poses.push_back(*output.odometry);
    if (output.step && output.step->status == StepStatus::kConfirmed) {
      walk.steps.push_back(*output.step);
    }
  }
  return walk;
}

TEST(PdrHeight, StairsRaiseThePoseAndShortenTheSteps) {
  const made::HeightProfile height = made::stairs(kStairsBegin, 3);
  Pdr pdr;
  const Walk walk =
      run(pdr, walking(), made::read_pressure(height, kWalkSeconds, 25.0, {.noise_pa = 2.0}));
  EXPECT_NEAR(walk.poses.back().position_m.z(), 9.0, 0.5);
  EXPECT_EQ(pdr.height().floors().floor(), 3);
  int inside = 0;
  for (const PoseEstimate& pose : walk.poses) {
    const double error = pose.position_m.z() - height(to_seconds(pose.stamp_ns));
    inside += error * error < 3.84 * pose.covariance(2, 2) ? 1 : 0;
    EXPECT_LT(std::abs(error), 1.2);  // until it is known for a climb
  }
  EXPECT_GT(inside, static_cast<int>(0.93 * static_cast<double>(walk.poses.size())));
  // A step on stairs is 0.29 m once the climb is known, those of the level are as long as ever.
  double on_level = 0.0;
  double on_flight = 0.0;
  int of_flight = 0;
  for (const StepEvent& step : walk.steps) {
    const double t = to_seconds(step.stamp_ns);
    if (t < kStairsBegin) on_level = step.length_m;
    if (t < kStairsBegin + 9.5 || t > kStairsBegin + 12.5) continue;  // of the second flight
    on_flight += step.length_m;
    ++of_flight;
  }
  EXPECT_GT(on_level, 0.5);
  EXPECT_NEAR(on_flight / of_flight, 0.29, 0.06);
  EXPECT_NEAR(walk.steps.back().length_m, on_level, 0.02);
}

TEST(PdrHeight, WithoutPressureItIsTheOriginsAndUncertain) {
  Pdr pdr;
  const Walk walk = run(pdr, walking(), {});
  EXPECT_EQ(walk.poses.back().position_m.z(), 0.0);
  const double path_m = pdr.dead_reckoning().path_length_m();
  EXPECT_NEAR(walk.poses.back().covariance(2, 2), 0.25 + 0.0025 * path_m * path_m, 1e-9);
  EXPECT_FALSE(pdr.height().known());
}

TEST(PdrHeight, ABarometerOnTheLevelLeavesStepsAndPositionAlone) {
  const made::HeightProfile level = [](double) { return 0.0; };
  Pdr with;
  Pdr without;
  const Walk a = run(with, walking(), made::read_pressure(level, kWalkSeconds, 25.0));
  const Walk b = run(without, walking(), {});
  EXPECT_EQ(with.step_count(), without.step_count());
  EXPECT_EQ(with.dead_reckoning().position_m(), without.dead_reckoning().position_m());
  EXPECT_NEAR(a.poses.back().position_m.z(), 0.0, 0.2);
  EXPECT_LT(a.poses.back().covariance(2, 2), b.poses.back().covariance(2, 2));
}

TEST(PdrHeight, BadPressuresAreRefused) {
  Pdr pdr;
  EXPECT_EQ(pdr.process(PressureSample{to_ns(1.0), 100000.0}), Refusal::kNone);
  EXPECT_EQ(pdr.process(PressureSample{to_ns(1.0), 100000.0}), Refusal::kDuplicate);
  EXPECT_EQ(pdr.process(PressureSample{to_ns(2.0), std::numeric_limits<double>::quiet_NaN()}),
            Refusal::kNonFinite);
  EXPECT_EQ(pdr.process(PressureSample{to_ns(2.0), 1000.0}), Refusal::kOutOfRange);
  EXPECT_EQ(pdr.pressure_gate().refused(), 3U);
}

TEST(PdrHeight, ALateBarometerBeginsWhereTheWalkMayBe) {
  const made::HeightProfile level = [](double) { return 0.0; };
  std::vector<PressureSample> pressure = made::read_pressure(level, kWalkSeconds, 10.0);
  std::erase_if(pressure, [](const PressureSample& s) { return s.stamp_ns < to_ns(60.0); });
  Pdr pdr;
  const Walk walk = run(pdr, walking(), pressure);
  // 100 steps of 0.6 m, of which a twentieth may have led up or down.
  EXPECT_GT(walk.poses.back().covariance(2, 2), 4.0);
}

TEST(PdrHeight, FollowsASimulatedWalkerThroughABuilding) {
  simulation::WalkOptions options;
  options.seed = 1;  // up at 50 s, down at 250 s
  options.duration_s = 290.0;
  options.building.storeys = 4;
  options.camera_rate_hz = 0.0;
  options.imu_rate_hz = 100.0;
  const simulation::SimulatedWalk simulated = simulation::simulate_walk(options);
  PdrConfig config;
  config.carry = Carry::kHead;
  Pdr pdr(config);
  made::Readings readings;
  readings.imu = simulated.imu;
  readings.mag = simulated.mag;
  const Walk walk = run(pdr, readings, simulated.pressure);
  const double start_m = simulated.state_at(simulated.imu.front().stamp_ns).position_m.z();
  double squares = 0.0;
  double range = 0.0;
  for (const PoseEstimate& pose : walk.poses) {
    const double truth = simulated.state_at(pose.stamp_ns).position_m.z() - start_m;
    squares += (pose.position_m.z() - truth) * (pose.position_m.z() - truth);
    range = std::max(range, std::abs(truth));
  }
  EXPECT_GT(range, 2.5);  // or the walk shows nothing
  EXPECT_LT(std::sqrt(squares / static_cast<double>(walk.poses.size())), 0.4);
  const double end = simulated.state_at(walk.poses.back().stamp_ns).position_m.z() - start_m;
  EXPECT_NEAR(walk.poses.back().position_m.z(), end, 0.5);
  EXPECT_EQ(pdr.height().floors().floor(), std::lround(end / 3.0));
}

}  // namespace
}  // namespace vpdr::pdr
