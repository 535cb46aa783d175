#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/rotation.hpp"
#include "pdr/core/heading/carried_axis.hpp"
#include "pdr/core/pdr.hpp"
#include "tests/unit/pdr/made_walk.hpp"

namespace vpdr::pdr {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using News = CarriedAxis::News;

constexpr double kRate = 50.0;

/// Yaw of the walker, and how the device is held against a walker who looks along x.
struct Scene {
  std::function<double(double)> yaw_rad = [](double) { return 0.5; };
  std::function<Quaterniond(double)> held = [](double) { return Quaterniond::Identity(); };
  std::function<bool(double)> walking = [](double) { return true; };
};

/// From one posture to the other within 0.8 s from `begin_s` on.
std::function<Quaterniond(double)> moved(const Vector3d& axis, double degrees, double begin_s) {
  return [=](double t) {
    const double share = std::clamp((t - begin_s) / 0.8, 0.0, 1.0);
    return Quaterniond(AngleAxisd(to_radians(degrees) * share, axis));
  };
}

struct Seen {
  double largest_error_rad = 0.0;  ///< of the heading, while walking
  double least_clarity = 1.0;
  int carried_on = 0;
  int anew = 0;
};

Seen watch(CarriedAxis& axis, const Scene& scene, double duration_s) {
  Seen seen;
  for (int i = 0; i < static_cast<int>(duration_s * kRate); ++i) {
    const double t = i / kRate;
    const Quaterniond walker(AngleAxisd(scene.yaw_rad(t), Vector3d::UnitZ()));
    axis.add(to_ns(t), walker * scene.held(t), scene.walking(t));
    if (!scene.walking(t)) continue;
    const Eigen::Vector2d& heading = axis.heading();
    const double error = wrap_pi(std::atan2(heading.y(), heading.x()) - scene.yaw_rad(t));
    seen.largest_error_rad = std::max(seen.largest_error_rad, std::abs(error));
    seen.least_clarity = std::min(seen.least_clarity, heading.norm());
    const News news = axis.take_news();
    seen.carried_on += news == News::kCarriedOn ? 1 : 0;
    seen.anew += news == News::kAnew ? 1 : 0;
  }
  return seen;
}

CarriedAxis in_hand() { return {HeadingConfig{}.turned_over_rad, Carry::kHand}; }

TEST(CarriedAxis, IsAtFirstTheForwardAxis) {
  CarriedAxis axis = in_hand();
  const Seen seen = watch(axis, {.yaw_rad = [](double t) { return 0.3 * t; }}, 20.0);
  EXPECT_LT(seen.largest_error_rad, 1e-9);
  EXPECT_TRUE(axis.is_forward_axis());
  EXPECT_EQ(seen.anew, 1);
  EXPECT_EQ(seen.carried_on, 0);
}

TEST(CarriedAxis, TheFirstConfirmedStepHearsOfAWalk) {
  CarriedAxis axis = in_hand();
  watch(axis, {.walking = [](double) { return false; }}, 3.0);
  EXPECT_EQ(axis.take_news(), News::kAnew);
  EXPECT_EQ(watch(axis, {}, 3.0).anew, 0);
}

TEST(CarriedAxis, ADeviceTakenDownOrTurnedOverTellsTheSameDirection) {
  for (const double degrees : {90.0, -90.0, 120.0, 180.0}) {
    CarriedAxis axis = in_hand();
    const Scene scene{.held = moved(Vector3d::UnitY(), degrees, 5.0)};
    const Seen seen = watch(axis, scene, 12.0);
    EXPECT_LT(seen.largest_error_rad, 0.1) << degrees;
    EXPECT_GT(seen.least_clarity, 0.35) << degrees;  // steeper it is held
    EXPECT_EQ(seen.carried_on, 1) << degrees;
    EXPECT_FALSE(axis.is_forward_axis());
    // From then on it turns with its owner.
    const Scene turning{.yaw_rad = [](double t) { return 0.5 + 0.5 * t; },
                        .held = [&](double) { return scene.held(12.0); }};
    EXPECT_LT(watch(axis, turning, 10.0).largest_error_rad, 0.1) << degrees;
  }
}

TEST(CarriedAxis, AForwardAxisThatStaysLevelStillTellsIt) {
  CarriedAxis axis = in_hand();
  const Seen seen = watch(axis, {.held = moved(Vector3d::UnitX(), 90.0, 5.0)}, 12.0);
  EXPECT_LT(seen.largest_error_rad, 1e-9);
  EXPECT_EQ(seen.carried_on, 0);
}

TEST(CarriedAxis, AGlanceChangesNothing) {
  CarriedAxis axis = in_hand();
  const auto up = moved(Vector3d::UnitY(), 70.0, 5.0);
  const auto back = moved(Vector3d::UnitY(), -70.0, 6.5);
  const Seen seen = watch(axis, {.held = [&](double t) { return up(t) * back(t); }}, 14.0);
  EXPECT_LT(seen.largest_error_rad, 0.1);
  EXPECT_EQ(seen.carried_on, 0);
  EXPECT_TRUE(axis.is_forward_axis());
}

TEST(CarriedAxis, AnArmThatSwingsWidelyHoldsNoDirectionForEver) {
  CarriedAxis axis = in_hand();
  const auto down = moved(Vector3d::UnitY(), 90.0, 5.0);
  const auto held = [&](double t) {
    const double swing = t > 5.0 ? to_radians(65.0) * std::sin(2.0 * kPi * 0.75 * t) : 0.0;
    return down(t) * Quaterniond(AngleAxisd(swing, Vector3d::UnitY()));
  };
  const Seen seen = watch(axis, {.held = held}, 15.0);
  EXPECT_LT(seen.largest_error_rad, 0.1);
  EXPECT_EQ(seen.carried_on, 1);
  const Scene turned{.yaw_rad = [](double) { return 2.0; },
                     .held = [&](double t) { return held(t + 15.0); }};
  watch(axis, turned, 4.0);
  EXPECT_LT(watch(axis, turned, 5.0).largest_error_rad, 0.1);
}

TEST(CarriedAxis, AnArmThatHangsHasAnAxisToo) {
  CarriedAxis axis = in_hand();
  const Seen seen = watch(axis, {.held = moved(Vector3d::UnitY(), 90.0, -1.0)}, 5.0);
  EXPECT_FALSE(axis.is_forward_axis());
  EXPECT_GT(seen.least_clarity, 0.99);
}

/// Walks, stands from 5 s to 12 s, and walks on.
bool walks_around_a_stand(double t) { return t < 5.0 || t > 12.0; }

TEST(CarriedAxis, WhoStandsMayTurnSoThatItIsTakenUpAnew) {
  CarriedAxis axis = in_hand();
  const Seen seen = watch(
      axis, {.held = moved(Vector3d::UnitY(), 90.0, 8.0), .walking = walks_around_a_stand}, 16.0);
  EXPECT_EQ(seen.carried_on, 0);
  EXPECT_EQ(seen.anew, 2);
  EXPECT_FALSE(axis.is_forward_axis());
}

TEST(CarriedAxis, InALongSilenceItMayBeTakenUpAnew) {
  for (const double degrees : {0.0, 90.0}) {
    CarriedAxis axis = in_hand();
    watch(axis, {}, 5.0);
    const Quaterniond later = Quaterniond(AngleAxisd(2.5, Vector3d::UnitZ())) *
                              Quaterniond(AngleAxisd(to_radians(degrees), Vector3d::UnitY()));
    int anew = 0;
    for (int i = 0; i < 200; ++i) {
      axis.add(to_ns(25.0 + i / kRate), later, true);
      const News news = axis.take_news();
      EXPECT_NE(news, News::kCarriedOn);
      anew += news == News::kAnew ? 1 : 0;
    }
    EXPECT_EQ(anew, degrees > 0.0 ? 1 : 0);
    EXPECT_NEAR(std::atan2(axis.heading().y(), axis.heading().x()), 2.5, 1e-9);
  }
}

TEST(CarriedAxis, WhoSitsDownHasItInTheSamePocketAfterwards) {
  CarriedAxis axis(HeadingConfig{}.turned_over_rad, Carry::kPocket);
  const auto down = moved(Vector3d::UnitY(), 80.0, 7.0);
  const auto up = moved(Vector3d::UnitY(), -80.0, 9.5);
  const Seen seen = watch(
      axis, {.held = [&](double t) { return down(t) * up(t); }, .walking = walks_around_a_stand},
      16.0);
  EXPECT_EQ(seen.anew, 1);  // at the very first
  EXPECT_EQ(seen.carried_on, 0);
  EXPECT_LT(seen.largest_error_rad, 0.01);
}

TEST(CarriedAxis, OnTheTrunkNothingMovesIt) {
  CarriedAxis axis(HeadingConfig{}.turned_over_rad, Carry::kChest);
  const Seen seen = watch(axis, {.held = moved(Vector3d::UnitY(), 60.0, 5.0)}, 12.0);
  EXPECT_EQ(seen.anew + seen.carried_on, 0);
  EXPECT_NEAR(seen.least_clarity, 0.5, 1e-6);  // cos 60 degrees
}

TEST(Pdr, APhoneTakenDownInTheMiddleOfAWalkWalksOn) {
  made::Motion motion;
  motion.angles = [](double t) {
    return EulerAngles{0.0, 1.5 * std::clamp((t - 20.0) / 0.8, 0.0, 1.0), 0.0};
  };
  motion.upward_mps2 = made::bounce(1.8);
  const made::Readings readings = made::read(motion, 40.0, 100.0);
  PdrConfig config;
  config.carry = Carry::kHand;
  Pdr pdr(config);
  PdrOutput output;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    pdr.process(readings.mag[i]);
    pdr.process(readings.imu[i], output);
  }
  const Eigen::Vector2d position = pdr.dead_reckoning().position_m();
  EXPECT_GT(position.x(), 35.0);
  EXPECT_LT(std::abs(position.y()), 1.5);
  // Its owner may have turned a little meanwhile: 0.4 rad over half of the way.
  EXPECT_GT(output.odometry->covariance(1, 1), 25.0);
}

TEST(Pdr, TheFirstStepOfADeviceCarriedAnewIsAsUnsureAsTheOthers) {
  made::Motion motion;
  motion.angles = [](double t) {
    return EulerAngles{0.0, 1.5 * std::clamp((t - 18.0) / 0.8, 0.0, 1.0), 0.0};
  };
  motion.upward_mps2 = [](double t) { return t > 15.0 && t < 22.0 ? 0.0 : made::bounce(1.8)(t); };
  const made::Readings readings = made::read(motion, 35.0, 100.0);
  Pdr pdr;
  PdrOutput output;
  std::optional<StepEvent> first;
  for (std::size_t i = 0; i < readings.imu.size(); ++i) {
    pdr.process(readings.mag[i]);
    pdr.process(readings.imu[i], output);
    const bool confirmed = output.step && output.step->status == StepStatus::kConfirmed;
    if (confirmed && output.step->stamp_ns > to_ns(21.0) && !first) first = output.step;
  }
  ASSERT_TRUE(first);
  EXPECT_GT(first->yaw_sigma_rad, 1.0);
}

}  // namespace
}  // namespace vpdr::pdr
