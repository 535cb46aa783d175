// Boards as their makers have them before any calibration: iron as strong as the earth's field, a
// gyroscope that is degrees a second off.
#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "tests/unit/pdr/attitude/attitude_run.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using made::kField;

const Vector3d kIron(24.0, -26.0, 20.0);

/// A hand that turns the board about all axes, never still.
made::Motion turned_about() {
  made::Motion motion;
  motion.angles = [](double t) {
    return EulerAngles{0.6 * std::sin(1.1 * t), 0.5 * std::sin(1.7 * t), 0.8 * t};
  };
  return motion;
}

/// Readings of that board, turned into the world, with iron of its own and magnets of the place.
template <typename Sink, typename Magnet>
void feed(Sink sink, double from_s, double to_s, const Vector3d& iron_ut, Magnet magnet_ut) {
  const made::Motion motion = turned_about();
  for (double t = from_s; t < to_s; t += 0.075) {
    const Matrix3d rotation = from_euler(motion.angles(t)).toRotationMatrix();
    sink(Vector3d(kField + magnet_ut(t) + rotation * iron_ut), rotation);
  }
}

Vector3d no_magnet(double /*t*/) { return Vector3d::Zero(); }

TEST(UncalibratedBoard, ItsIronIsFound) {
  for (const double share : {0.5, 1.0, 1.5}) {
    MagneticOffset offset{MagneticOffsetConfig{}};
    const auto sink = [&](const Vector3d& field, const Matrix3d& rotation) {
      offset.add(field, rotation, 0.075);
    };
    feed(sink, 0.0, 15.0, share * kIron, no_magnet);
    EXPECT_LT((offset.offset_ut() - share * kIron).norm(), 4.0) << share;
    EXPECT_LT((offset.field_ut() - kField).norm(), 4.0) << share;
  }
}

TEST(UncalibratedBoard, MagnetsOnTheWayAreNotItsIron) {
  MagneticOffset offset{MagneticOffsetConfig{}};
  const auto magnets = [](double t) {
    return Vector3d(40.0 * std::sin(0.9 * t), -30.0 * std::cos(1.3 * t), 25.0 * std::sin(0.4 * t));
  };
  const auto sink = [&](const Vector3d& field, const Matrix3d& rotation) {
    offset.add(field, rotation, 0.075);
    EXPECT_LT(offset.offset_ut().norm(), 10.0);
  };
  feed(sink, 0.0, 60.0, Vector3d::Zero(), magnets);
}

TEST(UncalibratedBoard, AFieldThatTheEarthHasNowhereTellsOfIronAtTheStart) {
  MagneticOffset offset{MagneticOffsetConfig{}};
  offset.add(kField + Vector3d(0.0, 0.0, -50.0), Matrix3d::Identity(), 0.075);
  // hypot(20, 90) = 92.2 uT, 25.2 beyond the strongest.
  EXPECT_NEAR(std::sqrt(offset.covariance_ut2()(0, 0)), std::hypot(20.0, 90.0) - 67.0, 1e-6);
}

TEST(UncalibratedBoard, AHeadingThatFollowedTheIronIsDoubtedOnce) {
  MagneticReference reference{MagneticConfig{}};
  double told_rad2 = 0.0;
  int times = 0;
  const auto sink = [&](const Vector3d& field, const Matrix3d& rotation) {
    const auto judgement = reference.judge({field, Vector3d::Zero(), rotation}, 0.075);
    told_rad2 += judgement.stale_rad2;
    times += judgement.stale_rad2 > 0.0 ? 1 : 0;
  };
  for (int i = 0; i < 200; ++i) sink(kField + kIron, Matrix3d::Identity());  // a still board
  EXPECT_EQ(times, 0);
  feed(sink, 0.0, 60.0, kIron, no_magnet);
  // The heading was off by atan2(24, 20 - 26), 104 degrees.
  EXPECT_GT(std::sqrt(told_rad2), 1.0);
  EXPECT_LE(times, 3);
}

TEST(UncalibratedBoard, AHeadingFromBeforeTheMagnetIsNotDoubted) {
  MagneticReference reference{MagneticConfig{}};
  double told_rad2 = 0.0;
  const auto sink = [&](const Vector3d& field, const Matrix3d& rotation) {
    told_rad2 += reference.judge({field, Vector3d::Zero(), rotation}, 0.075).stale_rad2;
  };
  feed(sink, 0.0, 30.0, Vector3d::Zero(), no_magnet);
  feed(sink, 30.0, 120.0, kIron, no_magnet);
  EXPECT_LT((reference.offset().offset_ut() - kIron).norm(), 5.0);
  EXPECT_EQ(told_rad2, 0.0);
}

TEST(UncalibratedBoard, TheHeadingIsRightOnceItsIronIsKnown) {
  for (const double share : {0.5, 1.0, 1.5}) {
    made::Readings readings = made::read(turned_about(), 60.0, 100.0);
    made::add_noise(readings, 0.002, 0.1, 0.5, 3);
    for (MagSample& s : readings.mag) s.field_ut += share * kIron;
    AttitudeFilter filter(made::prompt_sensors());
    EXPECT_LT(made::largest_error(filter, readings, 25.0), to_radians(8.0)) << share;
  }
}

TEST(UncalibratedBoard, ABadGyroscopesBiasIsFoundInMotion) {
  for (const double bias_degps : {3.0, 5.0}) {
    made::Motion motion;
    motion.angles = [](double t) {
      return EulerAngles{0.1 * std::sin(1.1 * t), 0.1 * std::sin(1.7 * t), 0.4 * std::sin(0.9 * t)};
    };
    made::Readings readings = made::read(motion, 90.0, 100.0);
    made::add_noise(readings, 0.002, 0.3, 0.3, 2);
    const Vector3d bias = to_radians(bias_degps) * Vector3d(1.0, -1.0, 1.0);
    for (ImuSample& s : readings.imu) s.angular_velocity_radps += bias;
    AttitudeFilter filter(made::prompt_sensors());
    EXPECT_LT(made::largest_error(filter, readings, 30.0), to_radians(8.0)) << bias_degps;
    EXPECT_FALSE(filter.at_rest());
    EXPECT_LT((filter.bias_radps() - bias).norm(), 5e-3) << bias_degps;
  }
}

}  // namespace
}  // namespace vpdr::pdr
