#include <gtest/gtest.h>

#include "calibration/calibrate.hpp"
#include "calibration/mount.hpp"
#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "dataset/recording.hpp"
#include "support/recordings.hpp"

namespace vpdr::calibration {
namespace {

using V = Eigen::Vector3d;

/// Two seconds of standing, then walking at 1.8 steps/s along the body's x: up and down, and a
/// quarter of a step ahead to and fro, with a sway to the sides at half the rhythm.
SensorStreams walk(const Eigen::Matrix3d& board_from_body, double seconds, double forward = 1.0) {
  SensorStreams streams;
  for (int i = 0; i < static_cast<int>(100 * (2.0 + seconds)); ++i) {
    const double t = 0.01 * i;
    V force(0, 0, kGravityMps2);
    if (t > 2.0) {
      const double phase = 2.0 * kPi * 1.8 * (t - 2.0);
      force +=
          V(-1.2 * forward * std::sin(phase), 1.5 * std::sin(0.5 * phase), 2.5 * std::cos(phase));
    }
    streams.force_mps2.push_back({to_ns(t), board_from_body * force});
    streams.rate_radps.push_back({to_ns(t), V::Zero()});
  }
  return streams;
}

TEST(Mount, FindsForwardHoweverTheBoardHangs) {
  for (const double yaw : {0.0, 1.0, 2.5, -2.0}) {
    const Eigen::Matrix3d board_from_body =
        (Eigen::AngleAxisd(0.4, V::UnitX()) * Eigen::AngleAxisd(yaw, V::UnitZ()))
            .toRotationMatrix();
    const auto mount = estimate_mount(walk(board_from_body, 12.0));
    ASSERT_TRUE(mount) << mount.error().message;
    EXPECT_LT(
        (mount.value().body_from_board * board_from_body - Eigen::Matrix3d::Identity()).norm(),
        0.05)
        << yaw;
    EXPECT_NEAR(mount.value().step_hz, 1.8, 0.03);
    EXPECT_NEAR(mount.value().lead_rad, kPi / 2, 0.1);
  }
}

TEST(Mount, RefusesWithoutStandingOrWalking) {
  SensorStreams standing = walk(Eigen::Matrix3d::Identity(), 0.0);
  const auto no_walk = estimate_mount(standing);
  ASSERT_FALSE(no_walk);
  EXPECT_NE(no_walk.error().message.find("ten steps"), std::string::npos);
  SensorStreams walking = walk(Eigen::Matrix3d::Identity(), 12.0);
  walking.force_mps2.erase(walking.force_mps2.begin(), walking.force_mps2.begin() + 250);
  walking.rate_radps.erase(walking.rate_radps.begin(), walking.rate_radps.begin() + 250);
  const auto no_rest = estimate_mount(walking);
  ASSERT_FALSE(no_rest);
  EXPECT_NE(no_rest.error().message.find("stand"), std::string::npos);
}

TEST(Mount, RefusesStepsOnTheSpot) {
  // Up and down only, with a trace of acceleration in phase with it: neither forward nor backward.
  SensorStreams streams = walk(Eigen::Matrix3d::Identity(), 12.0, 0.0);
  for (TimedVector& f : streams.force_mps2) f.value.x() += 0.2 * (f.value.z() - kGravityMps2);
  EXPECT_FALSE(estimate_mount(streams));
}

TEST(Mount, OfABeltOnTheLowerBack) {
  VPDR_REQUIRE_RECORDINGS(root);
  // The sensor's x points up and its z forward. Where the walker stands first, both are found.
  for (const char* name : {"HA001_Test11_Trial1", "MS001_Test11_Trial1"}) {
    const auto recording = dataset::read_recording(root / "walks/mobilised_waist" / name,
                                                   {.images = false, .truth = false});
    SensorStreams streams;
    for (const ImuSample& s : recording.imu) {
      streams.force_mps2.push_back({s.stamp_ns, s.specific_force_mps2});
      streams.rate_radps.push_back({s.stamp_ns, s.angular_velocity_radps});
    }
    const auto mount = estimate_mount(streams);
    ASSERT_TRUE(mount) << name << ": " << mount.error().message;
    EXPECT_GT(mount.value().body_from_board(2, 0), 0.95) << name;
    EXPECT_GT(mount.value().body_from_board(0, 2), std::cos(to_radians(15.0))) << name;
  }
}

}  // namespace
}  // namespace vpdr::calibration
