// What holds for any motion: which way the board is mounted, how fast it samples and what its clock
// shows change nothing; what breaks off or breaks is noticed, survived and owned up to.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <random>

#include "core/rotation.hpp"
#include "tests/unit/pdr/attitude/attitude_run.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using made::largest_error;
using made::Motion;
using made::prompt_sensors;
using made::Readings;

/// Turns, sways and bounces like someone who walks in circles.
Motion circling() {
  Motion motion;
  motion.angles = [](double t) {
    return EulerAngles{0.2 * std::sin(5.0 * t), 0.15 * std::cos(3.3 * t),
                       0.5 * t + 0.3 * std::sin(2.0 * t)};
  };
  motion.upward_mps2 = made::bounce(1.8);
  return motion;
}

Readings noisy(double duration_s, double rate_hz, unsigned seed) {
  Readings readings = made::read(circling(), duration_s, rate_hz);
  made::add_noise(readings, 0.005, 0.1, 0.5, seed);
  return readings;
}

Readings mounted(Readings readings, const Quaterniond& board_from_body) {
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    ImuSample& s = readings.imu[i];
    s.specific_force_mps2 = board_from_body * s.specific_force_mps2;
    s.angular_velocity_radps = board_from_body * s.angular_velocity_radps;
    readings.mag[i].field_ut = board_from_body * readings.mag[i].field_ut;
    readings.truth[i] = readings.truth[i] * board_from_body.conjugate();
  }
  return readings;
}

bool finite(const AttitudeFilter& filter) {
  const AttitudeEstimate estimate = filter.estimate();
  return estimate.world_from_body.coeffs().allFinite() && estimate.covariance_rad2.allFinite() &&
         estimate.gyro_bias_radps.allFinite() && estimate.angular_velocity_radps.allFinite();
}

void expect_honest_form(const Eigen::Matrix3d& covariance) {
  EXPECT_LT((covariance - covariance.transpose()).norm(), 1e-9 * covariance.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance, Eigen::EigenvaluesOnly)
                .eigenvalues()
                .minCoeff(),
            0.0);
}

TEST(AttitudeProperties, TurningTheBoardTurnsNothingButTheMount) {
  const Readings straight = noisy(40.0, 100.0, 3);
  AttitudeConfig config = prompt_sensors();
  config.error.initial_scale_sigma = 1e-9;  // a scale for each axis knows the board's axes
  AttitudeFilter reference(config);
  largest_error(reference, straight);
  for (const Vector3d& axis : {Vector3d(0.5 * kPi, 0.0, 0.0), Vector3d(0.0, 0.5 * kPi, 0.0),
                               Vector3d(kPi, 0.0, 0.0), Vector3d(0.7, -1.1, 2.0)}) {
    const Quaterniond board_from_body = exp_rotation(axis);
    AttitudeFilter filter(config);
    largest_error(filter, mounted(straight, board_from_body));
    EXPECT_LT(
        (filter.world_from_body() * board_from_body).angularDistance(reference.world_from_body()),
        to_radians(1e-3))
        << axis.transpose();
    EXPECT_LT((filter.bias_radps() - board_from_body * reference.bias_radps()).norm(), 1e-6);
    EXPECT_LT((filter.estimate().covariance_rad2 - reference.estimate().covariance_rad2).norm(),
              1e-6);
  }
}

TEST(AttitudeProperties, ThatHoldsNearlyWithAScaleForEachAxis) {
  const Readings straight = noisy(40.0, 100.0, 3);
  for (const Vector3d& axis : {Vector3d(0.0, 0.5 * kPi, 0.0), Vector3d(0.7, -1.1, 2.0)}) {
    AttitudeFilter filter(prompt_sensors());
    EXPECT_LT(largest_error(filter, mounted(straight, exp_rotation(axis)), 15.0), to_radians(2.0));
  }
}

TEST(AttitudeProperties, TheRateOfSamplingDoesNotMatter) {
  double sigma_at_100 = 0.0;
  for (const double rate_hz : {100.0, 20.0, 50.0, 286.0, 1000.0}) {
    AttitudeFilter filter(prompt_sensors());
    EXPECT_LT(largest_error(filter, made::read(circling(), 40.0, rate_hz), 15.0), to_radians(2.5))
        << rate_hz;
    const double sigma = std::sqrt(filter.estimate().covariance_rad2(2, 2));
    if (rate_hz == 100.0) sigma_at_100 = sigma;
    EXPECT_NEAR(sigma / sigma_at_100, 1.0, 0.25) << rate_hz;
  }
}

TEST(AttitudeProperties, TheClockDoesNotMatter) {
  const Readings now = noisy(20.0, 100.0, 4);
  Readings later = now;
  const TimestampNs shift = 1'700'000'000'123'456'789;
  for (ImuSample& s : later.imu) s.stamp_ns += shift;
  for (MagSample& s : later.mag) s.stamp_ns += shift;
  AttitudeFilter a(prompt_sensors());
  AttitudeFilter b(prompt_sensors());
  largest_error(a, now);
  largest_error(b, later);
  EXPECT_EQ(a.world_from_body().coeffs(), b.world_from_body().coeffs());
  EXPECT_EQ(a.estimate().covariance_rad2, b.estimate().covariance_rad2);
}

TEST(AttitudeProperties, ADelayOfTheSensorsIsMadeUpFor) {
  // All readings of the body 20 ms ago, the field's of 30 ms ago.
  const Motion motion = circling();
  Motion late = motion;
  late.angles = [motion](double t) { return motion.angles(t - 0.02); };
  late.upward_mps2 = [motion](double t) { return motion.upward_mps2(t - 0.02); };
  Motion later = motion;
  later.angles = [motion](double t) { return motion.angles(t - 0.03); };
  const Readings delayed = made::read(late, 30.0, 200.0);
  const Readings truth = made::read(motion, 30.0, 200.0);
  const Readings field = made::read(later, 30.0, 200.0);
  const auto error_with = [&](double sensor_delay_s, double field_delay_s) {
    AttitudeConfig config;
    config.sensor_delay_s = sensor_delay_s;
    config.magnetic.delay_s = field_delay_s;
    AttitudeFilter filter(config);
    double sum = 0.0;
    for (std::size_t i = 0; i < truth.imu.size(); ++i) {
      filter.process(field.mag[i]);
      filter.process(delayed.imu[i]);
      const double e = filter.estimate().world_from_body.angularDistance(truth.truth[i]);
      if (i > truth.imu.size() / 2) sum += e * e;
    }
    return std::sqrt(2.0 * sum / static_cast<double>(truth.imu.size()));
  };
  EXPECT_GT(error_with(0.0, 0.0), to_radians(0.8));
  EXPECT_LT(error_with(0.02, 0.01), to_radians(0.5));
}

TEST(AttitudeProperties, NonFiniteSamplesChangeNothing) {
  const Readings readings = noisy(20.0, 100.0, 5);
  AttitudeFilter clean(prompt_sensors());
  AttitudeFilter soiled(prompt_sensors());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    if (i % 50 == 7) {
      ImuSample bad = readings.imu[i];
      bad.specific_force_mps2.y() = nan;
      soiled.process(bad);
      bad = readings.imu[i];
      bad.angular_velocity_radps.x() = std::numeric_limits<double>::infinity();
      soiled.process(bad);
      soiled.process(MagSample{readings.mag[i].stamp_ns, Vector3d(nan, nan, nan)});
    }
    clean.process(readings.mag[i]);
    clean.process(readings.imu[i]);
    soiled.process(readings.mag[i]);
    soiled.process(readings.imu[i]);
  }
  EXPECT_EQ(soiled.world_from_body().coeffs(), clean.world_from_body().coeffs());
}

TEST(AttitudeProperties, LostSamplesCostLittle) {
  const Readings all = noisy(60.0, 100.0, 6);
  Readings thinned;
  std::mt19937 random(7);
  for (std::size_t i = 0; i < all.imu.size(); ++i) {
    if (i > 0 && random() % 5 == 0) continue;
    thinned.imu.push_back(all.imu[i]);
    thinned.truth.push_back(all.truth[i]);
    if (random() % 5 != 0) thinned.mag.push_back(all.mag[i]);
  }
  AttitudeFilter filter(prompt_sensors());
  EXPECT_LT(largest_error(filter, thinned, 15.0), to_radians(3.0));
}

TEST(AttitudeProperties, AFieldThatBreaksOffIsOwnedUpTo) {
  Readings readings = noisy(120.0, 100.0, 8);
  readings.mag.resize(6000);
  AttitudeFilter filter(prompt_sensors());
  double while_seen = 0.0;
  std::size_t mag = 0;
  double largest = 0.0;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    while (mag < readings.mag.size() && readings.mag[mag].stamp_ns <= readings.imu[i].stamp_ns) {
      filter.process(readings.mag[mag++]);
    }
    filter.process(readings.imu[i]);
    if (i == 6000) while_seen = filter.estimate().covariance_rad2(2, 2);
    if (i > 6000) {
      largest = std::max(largest, filter.world_from_body().angularDistance(readings.truth[i]));
    }
  }
  const double sigma = std::sqrt(filter.estimate().covariance_rad2(2, 2));
  EXPECT_GT(sigma * sigma, 1.2 * while_seen);
  EXPECT_LT(largest, to_radians(5.0));
  EXPECT_TRUE(filter.estimate().yaw_is_absolute);
}

TEST(AttitudeProperties, ImpactsPoisonNothing) {
  Readings readings = noisy(60.0, 100.0, 9);
  for (std::size_t i = 2000; i < 4000; i += 97) {
    readings.imu[i].specific_force_mps2 = Vector3d(150.0, -180.0, 120.0);
    readings.imu[i + 1].specific_force_mps2 = Vector3d(-120.0, 150.0, -60.0);
  }
  AttitudeFilter filter(prompt_sensors());
  largest_error(filter, readings);
  ASSERT_TRUE(finite(filter));
  expect_honest_form(filter.estimate().covariance_rad2);
  EXPECT_LT(filter.world_from_body().angularDistance(readings.truth.back()), to_radians(4.0));
}

TEST(AttitudeProperties, AGyroscopeAtItsLimitIsOwnedUpTo) {
  Motion motion;  // a spin of 20 rad/s for 0.2 s, the gyroscope ends at 8.7
  motion.angles = [](double t) {
    return EulerAngles{0.0, 0.0, 20.0 * std::clamp(t - 10.0, 0.0, 0.2)};
  };
  Readings readings = made::read(motion, 11.0, 100.0);
  for (ImuSample& s : readings.imu) {
    s.angular_velocity_radps = s.angular_velocity_radps.cwiseMin(8.7).cwiseMax(-8.7);
  }
  AttitudeConfig config = prompt_sensors();
  config.use_magnetometer = false;
  AttitudeFilter limited(config);
  largest_error(limited, readings);
  const double error = limited.world_from_body().angularDistance(readings.truth.back());
  EXPECT_GT(error, 1.5);
  AttitudeFilter with_field(prompt_sensors());
  largest_error(with_field, Readings{{readings.imu.begin(), readings.imu.begin() + 1000},
                                     {readings.mag.begin(), readings.mag.begin() + 1000},
                                     {readings.truth.begin(), readings.truth.begin() + 1000}});
  const double before = with_field.estimate().covariance_rad2(2, 2);
  for (std::size_t i = 1000; i < 1060; ++i) with_field.process(readings.imu[i]);
  EXPECT_GT(std::sqrt(with_field.estimate().covariance_rad2(2, 2)), 0.4);
  EXPECT_GT(with_field.estimate().covariance_rad2(2, 2), 4.0 * before);
}

TEST(AttitudeProperties, AnAccelerometerAtItsLimitDoesNotTiltTheHorizon) {
  // Running: peaks of 4 g cut off at 2 g, on an axis that leans by half a radian.
  Motion motion;
  motion.angles = [](double t) { return EulerAngles{0.0, 0.5 + 0.3 * std::sin(8.5 * t), 0.1 * t}; };
  motion.upward_mps2 = [](double t) { return 25.0 * std::sin(17.0 * t); };
  Readings readings = made::read(motion, 40.0, 200.0);
  made::add_noise(readings, 0.005, 0.1, 0.5, 10);
  for (ImuSample& s : readings.imu) {
    s.specific_force_mps2 = s.specific_force_mps2.cwiseMin(19.6).cwiseMax(-19.6);
  }
  AttitudeFilter filter(prompt_sensors());
  largest_error(filter, readings);
  const Vector3d up =
      filter.world_from_body() * (readings.truth.back().conjugate() * Vector3d::UnitZ());
  EXPECT_LT(std::acos(std::min(1.0, up.z())), to_radians(6.0));
  expect_honest_form(filter.estimate().covariance_rad2);
}

TEST(AttitudeProperties, GapsOfSecondsAreOwnedUpToAndMended) {
  const Readings readings = noisy(60.0, 100.0, 11);
  AttitudeFilter filter(prompt_sensors());
  const auto feed = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      filter.process(readings.mag[i]);
      filter.process(readings.imu[i]);
    }
  };
  feed(0, 2000);
  const double before = filter.estimate().covariance_rad2(2, 2);
  feed(2400, 2402);
  EXPECT_GT(filter.estimate().covariance_rad2(2, 2), before + 1.0);
  expect_honest_form(filter.estimate().covariance_rad2);
  feed(2402, 5500);
  EXPECT_LT(filter.world_from_body().angularDistance(readings.truth[5499]), to_radians(4.0));
}

TEST(AttitudeProperties, AnyStartingPoseLevelsAndFindsNorth) {
  for (const Vector3d& axis :
       {Vector3d(0.0, -0.5 * kPi, 0.0), Vector3d(0.0, 0.5 * kPi, 0.0), Vector3d(kPi, 0.0, 0.0),
        Vector3d(0.5 * kPi, 0.0, 0.0), Vector3d(-0.5 * kPi, 0.0, 1.0), Vector3d(0.0, kPi, 0.0)}) {
    AttitudeFilter filter(prompt_sensors());
    const Readings readings = mounted(made::read(Motion{}, 1.0, 100.0), exp_rotation(axis));
    largest_error(filter, readings);
    EXPECT_LT(filter.world_from_body().angularDistance(readings.truth.back()), 1e-3)
        << axis.transpose();
  }
}

TEST(AttitudeProperties, NeitherNoiseNorTimeUnmakesTheCovariance) {
  AttitudeFilter filter(prompt_sensors());
  largest_error(filter, noisy(600.0, 100.0, 12));
  ASSERT_TRUE(finite(filter));
  expect_honest_form(filter.estimate().covariance_rad2);
  EXPECT_NEAR(filter.world_from_body().norm(), 1.0, 1e-6);
}

}  // namespace
}  // namespace vpdr::pdr
