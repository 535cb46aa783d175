// Who sets off gains speed, which must not tilt the horizon nor, through it, turn north. Who stops
// stands short of where the last step led.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/rotation.hpp"
#include "pdr/core/pdr.hpp"
#include "tests/unit/pdr/made_walk.hpp"

namespace vpdr::pdr {
namespace {

constexpr double kStepsPerSecond = 1.8;
constexpr double kSetsOff_s = 4.0;
constexpr double kSpeedMps = 1.3;

/// Stands for 4 s, then walks east at 1.3 m/s, reached within a second.
made::Motion walk_east() {
  made::Motion motion;
  motion.upward_mps2 = [](double t) {
    return t < kSetsOff_s ? 0.0 : made::bounce(kStepsPerSecond)(t - kSetsOff_s);
  };
  motion.horizontal_mps2 = [](double t) {
    const bool gains = t >= kSetsOff_s && t < kSetsOff_s + 1.0;
    return Eigen::Vector2d(gains ? kSpeedMps : 0.0, 0.0);
  };
  return motion;
}

struct Largest {
  double tilt_rad = 0.0;
  double yaw_rad = 0.0;
};

/// Errors of the odometry from 2 s after setting off on.
Largest errors_of(const PdrConfig& config) {
  Pdr pdr(config);
  PdrOutput output;
  Largest largest;
  const made::Readings readings = made::read(walk_east(), 15.0, 100.0);
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    pdr.process(readings.mag[i]);
    pdr.process(readings.imu[i], output);
    if (to_seconds(readings.imu[i].stamp_ns) < kSetsOff_s + 2.0) continue;
    const Eigen::Quaterniond error =
        output.odometry->world_from_body * readings.truth[i].conjugate();
    largest.tilt_rad =
        std::max(largest.tilt_rad, (error * Eigen::Vector3d::UnitZ()).head<2>().norm());
    largest.yaw_rad = std::max(largest.yaw_rad, std::abs(yaw_of(error)));
  }
  return largest;
}

TEST(SettingOff, StepsTellTheSpeedThatIsNoTilt) {
  PdrConfig config;
  config.carry = Carry::kChest;
  const Largest found = errors_of(config);
  EXPECT_LT(found.tilt_rad, to_radians(1.0));
  EXPECT_LT(found.yaw_rad, to_radians(1.0));
}

TEST(SettingOff, WhereTheWalkGoesNowhereKnownNoSpeedIsTold) {
  PdrConfig config;
  config.carry = Carry::kPocket;
  const Largest told_nothing = errors_of(config);
  config.carry = Carry::kChest;
  EXPECT_GT(told_nothing.tilt_rad, errors_of(config).tilt_rad);
}

TEST(Stopping, EachHaltTakesBackPartOfTheLastStep) {
  made::Motion motion;  // two walks of 8 s
  motion.upward_mps2 = [](double t) {
    const double since = std::fmod(t, 14.0) - 2.0;
    return since > 0.0 && since < 8.0 ? made::bounce(kStepsPerSecond)(since) : 0.0;
  };
  PdrConfig config;
  config.carry = Carry::kChest;
  config.attitude.use_magnetometer = false;
  Pdr pdr(config);
  PdrOutput output;
  double walked_m = 0.0;
  double last_m = 0.0;
  TimestampNs last_ns = 0;
  for (const ImuSample& sample : made::read(motion, 28.0, 100.0).imu) {
    pdr.process(sample, output);
    if (!output.step || output.step->status != StepStatus::kConfirmed) continue;
    if (to_seconds(output.step->stamp_ns - last_ns) > 3.0) walked_m -= 0.6 * last_m;
    last_ns = output.step->stamp_ns;
    last_m = output.step->length_m;
    walked_m += last_m;
  }
  ASSERT_GT(pdr.step_count(), 24U);
  EXPECT_NEAR(output.odometry->position_m.x(), walked_m - 0.6 * last_m, 1e-6);
  EXPECT_NEAR(output.odometry->position_m.y(), 0.0, 0.01);
}

}  // namespace
}  // namespace vpdr::pdr
