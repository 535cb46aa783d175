// Readings that are none: the attitude gets over them.
#include <gtest/gtest.h>

#include <cmath>

#include "attitude_run.hpp"
#include "core/rotation.hpp"

namespace vpdr::pdr {
namespace {

/// A board in a hand that is never at rest.
made::Motion handled() {
  made::Motion motion;
  motion.angles = [](double t) {
    return EulerAngles{0.3 * std::sin(2.0 * t), 0.2 * std::sin(3.0 * t), 0.3 * std::sin(t)};
  };
  motion.upward_mps2 = made::bounce(1.8);
  return motion;
}

TEST(AttitudeFaults, FindsALostHorizonAgain) {
  made::Readings readings = made::read(handled(), 60.0, 100.0);
  // A turn by two radians that there was not.
  for (std::size_t i = 2000; i < 2100; ++i) readings.imu[i].angular_velocity_radps.x() += 2.0;
  AttitudeFilter filter(made::prompt_sensors());
  EXPECT_LT(made::largest_error(filter, readings, 45.0), 0.1);
}

TEST(AttitudeFaults, AStuckAxisTurnsNothing) {
  made::Readings readings = made::read(handled(), 24.0, 100.0, 0, false);
  for (std::size_t i = 2000; i < 2300; ++i) readings.imu[i].angular_velocity_radps.z() = 1.5;
  AttitudeFilter filter(made::prompt_sensors());
  EXPECT_LT(made::largest_error(filter, readings), 0.6);
  EXPECT_GT(filter.estimate().covariance_rad2(2, 2), 0.2);
}

}  // namespace
}  // namespace vpdr::pdr
