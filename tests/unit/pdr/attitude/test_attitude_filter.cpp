#include <gtest/gtest.h>

#include <cmath>

#include "attitude_run.hpp"
#include "core/rotation.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using made::largest_error;
using made::Motion;
using made::prompt_sensors;
using made::Readings;

Motion turning(double rate_radps) {
  Motion motion;
  motion.angles = [=](double t) { return EulerAngles{0.1, -0.2, 0.5 + rate_radps * t}; };
  return motion;
}

TEST(AttitudeFilter, FollowsAnyMotionWithoutLag) {
  // (2): G_1 + G_2 = 1, so that with faultless sensors the estimate is the truth at any speed.
  Motion motion;
  motion.angles = [](double t) {
    return EulerAngles{0.5 * std::sin(2.0 * t), 0.4 * std::sin(3.1 * t), 0.8 * std::sin(1.3 * t)};
  };
  AttitudeFilter filter(prompt_sensors());
  EXPECT_LT(largest_error(filter, made::read(motion, 60.0, 200.0), 2.0), to_radians(0.1));
}

TEST(AttitudeFilter, StartsFromOneReadingOfEach) {
  AttitudeFilter filter(prompt_sensors());
  const Readings readings = made::read(turning(0.0), 1.0, 100.0);
  largest_error(filter, readings);
  EXPECT_LT(filter.world_from_body().angularDistance(readings.truth.back()), 1e-6);
  EXPECT_TRUE(filter.estimate().yaw_is_absolute);
}

TEST(AttitudeFilter, TurnsByTrueTimeAtAnyRate) {
  for (const double rate : {20.0, 50.0, 286.0, 1000.0}) {
    AttitudeConfig config = prompt_sensors();
    config.use_magnetometer = false;
    AttitudeFilter filter(config);
    Motion motion;  // 90 deg in 3 s, then still
    motion.angles = [](double t) {
      return EulerAngles{0.0, 0.0, 0.5 * kPi * std::clamp((t - 1.0) / 3.0, 0.0, 1.0)};
    };
    EXPECT_LT(largest_error(filter, made::read(motion, 5.0, rate), 4.5), to_radians(0.6)) << rate;
  }
}

TEST(AttitudeFilter, LostSamplesCostNoAngle) {
  AttitudeConfig config = prompt_sensors();
  config.use_magnetometer = false;
  AttitudeFilter filter(config);
  Motion motion;
  motion.angles = [](double t) {
    return EulerAngles{0.0, 0.0, 0.25 * kPi * (1.0 - std::cos(kPi * std::min(t, 3.0) / 3.0))};
  };
  Readings readings = made::read(motion, 4.0, 100.0);
  Readings thinned;
  std::mt19937 random(7);
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    if (i > 0 && random() % 5 == 0) continue;
    thinned.imu.push_back(readings.imu[i]);
    thinned.truth.push_back(readings.truth[i]);
  }
  largest_error(filter, thinned);
  EXPECT_NEAR(to_degrees(yaw_of(filter.world_from_body())), 90.0, 0.2);
}

TEST(AttitudeFilter, LearnsTheBiasAtRest) {
  AttitudeFilter filter(prompt_sensors());
  Readings readings = made::read(turning(0.0), 10.0, 100.0);
  made::add_noise(readings, 0.002, 0.02, 0.2, 1);
  const Vector3d bias(0.02, -0.01, 0.015);
  for (ImuSample& s : readings.imu) s.angular_velocity_radps += bias;
  largest_error(filter, readings);
  EXPECT_TRUE(filter.at_rest());
  EXPECT_LT((filter.bias_radps() - bias).norm(), 3e-4);
}

TEST(AttitudeFilter, LearnsTheBiasOfLevelAxesInMotion) {
  Motion motion;
  motion.angles = [](double t) {
    return EulerAngles{0.1 * std::sin(1.1 * t), 0.1 * std::sin(1.7 * t), 0.4 * std::sin(0.9 * t)};
  };
  Readings readings = made::read(motion, 120.0, 100.0);
  made::add_noise(readings, 0.002, 0.3, 0.3, 2);
  const Vector3d bias(0.01, -0.01, 0.01);
  for (ImuSample& s : readings.imu) s.angular_velocity_radps += bias;
  AttitudeFilter filter(prompt_sensors());
  largest_error(filter, readings);
  EXPECT_FALSE(filter.at_rest());
  EXPECT_LT((filter.bias_radps() - bias).norm(), 3e-3);
}

TEST(AttitudeFilter, WalkingDoesNotTiltTheHorizon) {
  Motion motion;
  motion.upward_mps2 = made::bounce(1.8, 4.0);
  Readings readings = made::read(motion, 30.0, 100.0);
  for (ImuSample& s : readings.imu) {  // forward and back with every step, to the sides with two
    const double t = to_seconds(s.stamp_ns);
    s.specific_force_mps2.x() += 2.0 * std::cos(2.0 * kPi * 1.8 * t);
    s.specific_force_mps2.y() += 1.5 * std::cos(2.0 * kPi * 0.9 * t);
  }
  AttitudeFilter filter(prompt_sensors());
  EXPECT_LT(largest_error(filter, readings, 5.0), to_radians(1.0));
}

TEST(AttitudeFilter, TheFieldNeverTiltsTheHorizon) {
  AttitudeFilter with_field(prompt_sensors());
  AttitudeConfig config = prompt_sensors();
  config.use_magnetometer = false;
  AttitudeFilter without(config);
  Readings readings = made::read(turning(0.0), 20.0, 100.0);
  for (std::size_t i = 300; i < readings.mag.size(); ++i) {
    readings.mag[i].field_ut += Vector3d(6.0, -5.0, 7.0);
  }
  largest_error(with_field, readings);
  largest_error(without, readings);
  const EulerAngles a = to_euler(with_field.world_from_body());
  const EulerAngles b = to_euler(without.world_from_body());
  EXPECT_NEAR(a.roll_rad, b.roll_rad, 1e-9);
  EXPECT_NEAR(a.pitch_rad, b.pitch_rad, 1e-9);
  EXPECT_GT(std::abs(a.yaw_rad - 0.5), 1e-3) << "the field did not reach heading at all";
}

TEST(AttitudeFilter, AMagnetNearbyIsNotFollowed) {
  AttitudeFilter filter(prompt_sensors());
  Readings readings = made::read(turning(0.0), 30.0, 100.0);
  for (std::size_t i = 1500; i < 2000; ++i) readings.mag[i].field_ut += Vector3d(60.0, 50.0, 20.0);
  double largest = 0.0;
  bool disturbed = false;
  std::size_t mag = 0;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    filter.process(readings.mag[mag++]);
    filter.process(readings.imu[i]);
    if (i > 1000) {
      largest = std::max(largest, filter.world_from_body().angularDistance(readings.truth[i]));
    }
    disturbed = disturbed || filter.magnetically_disturbed();
  }
  EXPECT_TRUE(disturbed);
  EXPECT_FALSE(filter.magnetically_disturbed());
  EXPECT_LT(largest, to_radians(1.0));
}

TEST(AttitudeFilter, WithoutAFieldYawIsRelative) {
  AttitudeFilter filter(prompt_sensors());
  largest_error(filter, made::read(turning(0.0), 5.0, 100.0, 0, false));
  EXPECT_FALSE(filter.estimate().yaw_is_absolute);
  EXPECT_NEAR(yaw_of(filter.world_from_body()), 0.0, 0.01);
  EXPECT_GT(std::sqrt(filter.estimate().covariance_rad2(2, 2)), 1.0);
}

TEST(AttitudeFilter, DeclinationTurnsMagneticToTrueNorth) {
  AttitudeConfig config = prompt_sensors();
  config.magnetic.declination_rad = to_radians(10.0);
  AttitudeFilter filter(config);
  largest_error(filter, made::read(turning(0.0), 5.0, 100.0));
  // Magnetic north is 10 deg east of true north: the magnetic yaw is 10 deg too large.
  EXPECT_NEAR(to_degrees(yaw_of(filter.world_from_body())), to_degrees(0.5) - 10.0, 0.05);
}

TEST(AttitudeFilter, EqualStampsMayComeInEitherOrder) {
  Motion motion = turning(0.3);
  motion.upward_mps2 = made::bounce(1.8);
  const Readings readings = made::read(motion, 10.0, 100.0);
  AttitudeFilter field_first(prompt_sensors());
  AttitudeFilter field_last(prompt_sensors());
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    field_first.process(readings.mag[i]);
    field_first.process(readings.imu[i]);
    field_last.process(readings.imu[i]);
    field_last.process(readings.mag[i]);
    EXPECT_EQ(field_first.world_from_body().coeffs(), field_last.world_from_body().coeffs());
  }
}

TEST(AttitudeFilter, TakesFieldsAtTheirOwnRateAndPhase) {
  const Motion motion = turning(2.0);
  Readings readings = made::read(motion, 20.0, 100.0);
  readings.mag.clear();
  for (int i = 0; i < 130; ++i) {  // 6.7 Hz, between the inertial samples
    const double t = 0.0037 + 0.149 * i;
    readings.mag.push_back({to_ns(t), from_euler(motion.angles(t)).conjugate() * made::kField});
  }
  AttitudeFilter filter(prompt_sensors());
  EXPECT_LT(largest_error(filter, readings, 1.0), to_radians(0.3));
  EXPECT_EQ(filter.dropped_fields(), 0U);
}

TEST(AttitudeFilter, CountsFieldsThatComeTooLate) {
  AttitudeFilter filter(prompt_sensors());
  const Readings readings = made::read(turning(0.0), 2.0, 100.0, 0, false);
  for (const ImuSample& s : readings.imu) filter.process(s);
  filter.process(MagSample{to_ns(0.5), made::kField});
  ImuSample next = readings.imu.back();
  next.stamp_ns += to_ns(0.01);
  filter.process(next);
  EXPECT_EQ(filter.dropped_fields(), 1U);
  EXPECT_FALSE(filter.estimate().yaw_is_absolute);
}

TEST(AttitudeFilter, AGapIsNotIntegratedAndWidensTheCovariance) {
  AttitudeFilter filter(prompt_sensors());
  Readings readings = made::read(turning(0.0), 10.0, 100.0);
  largest_error(filter, readings);
  const double before = filter.estimate().covariance_rad2(2, 2);
  const double level_before = filter.estimate().covariance_rad2(0, 0);
  ImuSample after = readings.imu.back();
  after.stamp_ns += to_ns(5.0);
  after.angular_velocity_radps = {0.0, 0.0, 3.0};  // 15 rad, were it integrated
  filter.process(after);
  EXPECT_NEAR(yaw_of(filter.world_from_body()), 0.5, to_radians(1.0));
  EXPECT_GT(filter.estimate().covariance_rad2(2, 2), before + 1.0);
  EXPECT_GT(filter.estimate().covariance_rad2(0, 0), level_before + 1.0);
}

TEST(AttitudeFilter, FindsItselfAgainAfterAGap) {
  AttitudeFilter filter(prompt_sensors());
  Readings readings = made::read(turning(0.0), 10.0, 100.0);
  largest_error(filter, readings);
  Motion other;
  other.angles = [](double) { return EulerAngles{-0.3, 0.2, 2.0}; };
  const Readings later = made::read(other, 10.0, 100.0, to_ns(15.0));
  EXPECT_LT(largest_error(filter, later, 5.0), to_radians(2.0));
}

TEST(AttitudeFilter, AccelerometerAloneGivesTheHorizon) {
  AttitudeFilter filter(prompt_sensors());
  Motion motion;
  motion.angles = [](double t) { return EulerAngles{0.3 * std::sin(0.2 * t), 0.2, 0.0}; };
  Readings readings = made::read(motion, 30.0, 100.0, 0, false);
  for (ImuSample& s : readings.imu) {
    s.has_angular_velocity = false;
    s.angular_velocity_radps.setZero();
  }
  largest_error(filter, readings);
  const EulerAngles truth = to_euler(readings.truth.back());
  const EulerAngles estimate = to_euler(filter.world_from_body());
  EXPECT_NEAR(estimate.roll_rad, truth.roll_rad, to_radians(3.0));
  EXPECT_NEAR(estimate.pitch_rad, truth.pitch_rad, to_radians(3.0));
  EXPECT_FALSE(filter.estimate().yaw_is_absolute);
}

TEST(AttitudeFilter, YawUncertaintyGrowsWithoutTheField) {
  AttitudeFilter filter(prompt_sensors());
  Motion motion;
  motion.angles = [](double t) { return EulerAngles{0.1 * std::sin(2.0 * t), 0.0, 0.3 * t}; };
  Readings readings = made::read(motion, 60.0, 100.0);
  readings.mag.resize(1000);
  largest_error(filter, made::Readings{{readings.imu.begin(), readings.imu.begin() + 1000},
                                       readings.mag,
                                       {readings.truth.begin(), readings.truth.begin() + 1000}});
  const double while_seen = filter.estimate().covariance_rad2(2, 2);
  largest_error(filter, made::Readings{{readings.imu.begin() + 1000, readings.imu.end()},
                                       {},
                                       {readings.truth.begin() + 1000, readings.truth.end()}});
  EXPECT_GT(filter.estimate().covariance_rad2(2, 2), 4.0 * while_seen);
  EXPECT_TRUE(filter.estimate().yaw_is_absolute);
}

TEST(AttitudeFilter, TheClockOfTheSamplesDoesNotMatter) {
  Motion motion = turning(0.4);
  motion.upward_mps2 = made::bounce(1.7);
  const Readings now = made::read(motion, 10.0, 100.0);
  const Readings later = made::read(motion, 10.0, 100.0, 1'600'000'000'000'000'000);
  AttitudeFilter a(prompt_sensors());
  AttitudeFilter b(prompt_sensors());
  largest_error(a, now);
  largest_error(b, later);
  EXPECT_EQ(a.world_from_body().coeffs(), b.world_from_body().coeffs());
}

}  // namespace
}  // namespace vpdr::pdr
