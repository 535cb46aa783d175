// A quarter of an hour through corridors: what is small over a minute must not add up.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/rotation.hpp"
#include "pdr/core/pdr.hpp"
#include "simulation/walk.hpp"

namespace vpdr::pdr {
namespace {

/// Mean over the walk, once a second after the first minute.
struct Figures {
  double yaw_error_rad = 0.0;  ///< r.m.s.
  double yaw_nees = 0.0;
  double position_error_m = 0.0;
  double position_nees = 0.0;  ///< of both directions; 1 where honest
};

Figures walk(std::uint64_t seed) {
  simulation::WalkOptions options;
  options.seed = seed;
  options.duration_s = 900.0;
  options.imu_rate_hz = 50.0;
  options.mag_rate_hz = 50.0;
  options.pressure_rate_hz = 0.0;
  options.camera_rate_hz = 0.0;
  const simulation::SimulatedWalk simulated = simulation::simulate_walk(options);
  PdrConfig config;
  config.carry = Carry::kHead;
  Pdr pdr(config);
  PdrOutput out;
  Figures sum;
  double count = 0.0;
  auto field = simulated.mag.begin();
  for (std::size_t i = 0; i < simulated.imu.size(); ++i) {
    const ImuSample& sample = simulated.imu[i];
    for (; field != simulated.mag.end() && field->stamp_ns <= sample.stamp_ns; ++field) {
      pdr.process(*field);
    }
    if (pdr.process(sample, out) != Refusal::kNone || i < 3000 || i % 50 != 0) continue;
    const simulation::MotionState truth = simulated.state_at(sample.stamp_ns);
    const double yaw =
        wrap_pi(yaw_of(out.odometry->world_from_body) - yaw_of(truth.world_from_body));
    const Eigen::Vector2d error = (out.odometry->position_m - truth.position_m).head<2>();
    sum.yaw_error_rad += yaw * yaw;
    sum.yaw_nees += yaw * yaw / out.odometry->covariance(5, 5);
    sum.position_error_m += error.norm();
    sum.position_nees +=
        0.5 * error.dot(out.odometry->covariance.topLeftCorner<2, 2>().inverse() * error);
    count += 1.0;
  }
  return {std::sqrt(sum.yaw_error_rad / count), sum.yaw_nees / count, sum.position_error_m / count,
          sum.position_nees / count};
}

TEST(LongWalk, HeadingAndItsCovarianceHold) {
  for (const std::uint64_t seed : {11U, 12U, 13U}) {
    const Figures figures = walk(seed);
    EXPECT_LT(to_degrees(figures.yaw_error_rad), 5.0) << "seed " << seed;
    EXPECT_LT(figures.yaw_nees, 2.0) << "seed " << seed;
    EXPECT_LT(figures.position_error_m, 6.0) << "seed " << seed;
    EXPECT_LT(figures.position_nees, 2.0) << "seed " << seed;
  }
}

}  // namespace
}  // namespace vpdr::pdr
