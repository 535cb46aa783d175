// What the attitude filter learns of its own errors: how large its noises are here and now, what
// the accelerometer's offset does to the horizon, how late the magnetometer is.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "core/square.hpp"
#include "pdr/core/attitude/correction_scale.hpp"
#include "pdr/core/attitude/horizon_base.hpp"
#include "pdr/core/attitude/magnetic_delay.hpp"
#include "tests/unit/pdr/attitude/attitude_run.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Mean factor over the second half of corrections of sigma `sigma` where one is expected.
double factor_of(double sigma) {
  constexpr int kCorrections = 7500;  // of 0.04 s
  CorrectionScale scale{CorrectionScaleConfig{}};
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, sigma);
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < kCorrections; ++i) {
    scale.add(Vector2d(normal(random), normal(random)), 2.0);
    scale.pass(0.04);
    if (i < kCorrections / 2) continue;
    sum += scale.factor();
    ++count;
  }
  return sum / count;
}

TEST(CorrectionScale, OneBlockByHand) {
  // A block of 6 s with a correction of 3 where variance 18 was expected: half. What is assumed
  // stands for as long: (1 + 0.5) / 2.
  CorrectionScale scale{CorrectionScaleConfig{}};
  EXPECT_EQ(scale.factor(), 1.0);
  scale.add(Vector2d(0.0, 3.0), 18.0);
  scale.pass(6.0);
  EXPECT_NEAR(scale.factor(), 0.75, 1e-12);
}

TEST(CorrectionScale, FollowsTheSizeOfTheCorrections) {
  EXPECT_NEAR(factor_of(1.0), 1.0, 0.4);
  EXPECT_NEAR(factor_of(0.5), 0.25, 0.1);
  EXPECT_NEAR(factor_of(2.0), 4.0, 1.6);
}

TEST(CorrectionScale, CorrectionsToOneSideCountForMoreThanNoise) {
  // Small ones that add up: what they are expected to sum up to grows as the root of their number.
  CorrectionScale drifting{CorrectionScaleConfig{}};
  for (int i = 0; i < 3000; ++i) {
    drifting.add(Vector2d(0.3, 0.0), 2.0);
    drifting.pass(0.04);
  }
  EXPECT_GT(drifting.factor(), 3.0);
}

TEST(CorrectionScale, IsHeldWithinItsBounds) {
  EXPECT_NEAR(factor_of(1e-3), CorrectionScaleConfig{}.least, 1e-12);
  EXPECT_LE(factor_of(1e3), CorrectionScaleConfig{}.largest);
}

TEST(CorrectionScale, ForgetsWhenNothingIsCorrected) {
  CorrectionScale scale{CorrectionScaleConfig{}};
  for (int i = 0; i < 3000; ++i) {
    scale.add(Vector2d(0.01, 0.0), 2.0);
    scale.pass(0.04);
  }
  ASSERT_LT(scale.factor(), 0.1);
  for (int i = 0; i < 3000; ++i) scale.pass(0.04);
  EXPECT_GT(scale.factor(), 0.8);
}

TEST(HorizonBase, StartsWithWhatIsAssumed) {
  const HorizonBase base{HorizonBaseConfig{}};
  EXPECT_NEAR(base.variance_rad2(), square(HorizonBaseConfig{}.sigma_rad), 1e-15);
}

TEST(HorizonBase, AnOffsetUprightTellsItsSizeByHand) {
  // 0.1 m/s^2 too much: 0.0102 rad; prior 0.02 of which a tenth of the variance stays:
  // (1.040e-4 + 0.1 * 4e-4) / 1.1.
  HorizonBase base({.sigma_rad = 0.02, .kept_share = 0.1});
  for (int i = 0; i < 3000; ++i) base.add(0.04 * (kGravityMps2 + 0.1), 0.04);
  const double seen = square(0.1 / kGravityMps2);
  EXPECT_NEAR(base.variance_rad2(), (seen + 0.1 * 4e-4) / 1.1, 1e-9);
}

TEST(HorizonBase, StepsAverageOut) {
  HorizonBase base{HorizonBaseConfig{}};
  double last = 0.0;
  for (int i = 0; i < 3000; ++i) {
    // A bobbing of 0.3 m/s at 2 Hz: up to 4 m/s^2.
    const double velocity = 0.3 * std::sin(4.0 * kPi * 0.04 * (i + 1));
    base.add(0.04 * kGravityMps2 + velocity - last, 0.04);
    last = velocity;
  }
  const HorizonBaseConfig config;
  const double kept = config.kept_share / (1.0 + config.kept_share);
  EXPECT_NEAR(std::sqrt(base.variance_rad2()), std::sqrt(kept) * config.sigma_rad, 1e-3);
}

TEST(HorizonBase, ReadingsAtTheirLimitAreNotTakenForAnOffset) {
  HorizonBase base{HorizonBaseConfig{}};
  for (int i = 0; i < 3000; ++i) base.add(0.04 * (kGravityMps2 - 3.0), 0.04);
  EXPECT_LT(base.variance_rad2(), 2.1 * square(HorizonBaseConfig{}.sigma_rad));
}

/// A body that swings to and fro and whose field comes `late_s` later than thought.
struct LateField {
  MagneticDelay delay{MagneticDelayConfig{}};

  void swing(double seconds, double late_s) {
    std::mt19937 random(4);
    std::normal_distribution<double> normal(0.0, 0.5);
    const Vector3d usual(0.0, 20.0, -40.0);
    for (int i = 0; 0.08 * i < seconds; ++i) {
      const double t = 0.08 * i;
      const Vector3d rate(0.8 * std::sin(5.0 * t), 0.5 * std::cos(7.0 * t), 0.3);
      const Vector3d slope = usual.cross(rate);
      const double rest_s = late_s - delay.excess_s();
      const Vector3d noise(normal(random), normal(random), normal(random));
      delay.add(noise - rest_s * slope, 1.0, slope, 0.08);
    }
  }
};

TEST(MagneticDelay, IsFoundWhileTheBodySwings) {
  for (const double late_s : {-0.01, 0.0, 0.025}) {
    LateField field;
    field.swing(30.0, late_s);
    EXPECT_NEAR(field.delay.excess_s(), late_s, 0.003) << late_s;
    EXPECT_LT(std::sqrt(field.delay.variance_s2()), 0.003);
  }
}

TEST(MagneticDelay, AStillBodyTellsNothing) {
  MagneticDelay delay{MagneticDelayConfig{}};
  for (int i = 0; i < 1000; ++i) delay.add(Vector3d(3.0, -2.0, 1.0), 9.0, Vector3d::Zero(), 0.08);
  EXPECT_EQ(delay.excess_s(), 0.0);
  EXPECT_NEAR(delay.variance_s2(), square(MagneticDelayConfig{}.sigma_s), 1e-15);
}

TEST(MagneticDelay, IsHeldWithinItsBounds) {
  LateField field;
  field.swing(60.0, 0.3);
  EXPECT_EQ(field.delay.excess_s(), MagneticDelayConfig{}.largest_s);
}

TEST(MagneticDelay, TheAttitudeFilterMakesUpForALateMagnetometer) {
  made::Motion motion;
  motion.angles = [](double t) {
    return EulerAngles{0.3 * std::sin(5.0 * t), 0.2 * std::sin(4.0 * t), 0.5 * std::sin(3.0 * t)};
  };
  made::Readings readings = made::read(motion, 60.0, 100.0);
  for (MagSample& sample : readings.mag) sample.stamp_ns += to_ns(0.03);
  AttitudeFilter filter(made::prompt_sensors());
  EXPECT_LT(made::largest_error(filter, readings, 30.0), to_radians(0.5));
  EXPECT_NEAR(filter.magnetic().delay_s(), 0.03, 0.003);
}

TEST(MagneticDelay, ALateMagnetometerMakesTheInertialSensorsSuspect) {
  const double unknown = square(0.008);
  LateField prompt;
  EXPECT_GT(prompt.delay.inertial_variance_s2(unknown), unknown) << "nothing was learned";
  prompt.swing(60.0, 0.0);
  EXPECT_LT(std::sqrt(prompt.delay.inertial_variance_s2(unknown)), 0.004);
  LateField late;
  late.swing(60.0, 0.025);
  EXPECT_GT(std::sqrt(late.delay.inertial_variance_s2(unknown)), 0.02);
}

}  // namespace
}  // namespace vpdr::pdr
