// Silences shorter than those that interrupt the filter: a radio that drops out, a busy board.
#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "pdr/core/attitude/attitude_filter.hpp"
#include "pdr/core/attitude/relative_attitude.hpp"
#include "pdr/core/attitude/unseen_motion.hpp"
#include "tests/unit/pdr/made_walk.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::Quaterniond;

/// A leg's swing: two strides in 2.2 s, and the bounce of the steps.
made::Motion pocket() {
  made::Motion motion;
  motion.angles = [](double t) {
    const double stride = 2.0 * kPi * 0.9 * t;
    return EulerAngles{0.1 * std::sin(stride + 1.0), 0.4 * std::sin(stride),
                       0.1 * std::sin(stride)};
  };
  motion.upward_mps2 = made::bounce(1.8);
  return motion;
}

/// Without the samples of the last 0.3 s of each 2.13 s: at any phase of the swing.
made::Readings with_silences(const made::Readings& whole) {
  made::Readings out;
  for (std::size_t i = 0; i < whole.imu.size(); ++i) {
    if (std::fmod(to_seconds(whole.imu[i].stamp_ns), 2.13) > 1.83) continue;
    out.imu.push_back(whole.imu[i]);
    out.truth.push_back(whole.truth[i]);
  }
  return out;
}

TEST(AttitudeSilences, WhatTheyHideIsOwnedUpToAndMended) {
  const made::Readings readings = with_silences(made::read(pocket(), 120.0, 100.0));
  AttitudeFilter filter;
  double squares = 0.0;
  double normalised = 0.0;
  double count = 0.0;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    filter.process(readings.imu[i]);
    if (to_seconds(readings.imu[i].stamp_ns) < 5.0) continue;
    const AttitudeEstimate now = filter.estimate();
    const Eigen::Vector2d tilt =
        log_rotation(readings.truth[i] * now.world_from_body.conjugate()).head<2>();
    squares += tilt.squaredNorm();
    normalised += 0.5 * tilt.dot(now.covariance_rad2.topLeftCorner<2, 2>().inverse() * tilt);
    count += 1.0;
  }
  EXPECT_LT(std::sqrt(squares / count), to_radians(6.0));
  EXPECT_LT(normalised / count, 2.0);
}

TEST(AttitudeSilences, HideNothingAtTwentyHertz) {
  EXPECT_EQ(unseen_turn_rad2(0.05), 0.0);
  EXPECT_NEAR(std::sqrt(unseen_turn_rad2(0.36)), 0.3, 1e-12);
  EXPECT_NEAR(std::sqrt(unseen_velocity_m2ps2(0.36)), 1.8, 1e-12);
}

TEST(AttitudeSilences, LeaveTheRelativeHeadingLessSure) {
  RelativeAttitude relative{AttitudeConfig{}};
  ImuSample sample;
  sample.specific_force_mps2 = {0.0, 0.0, kGravityMps2};
  for (const double t : {0.0, 0.01, 0.37}) {
    sample.stamp_ns = to_ns(t);
    relative.process(sample);
  }
  EXPECT_NEAR(relative.take_motion().blind_rad2, 0.06 * 0.06, 1e-9);
}

}  // namespace
}  // namespace vpdr::pdr
