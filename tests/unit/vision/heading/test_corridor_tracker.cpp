#include <gtest/gtest.h>

#include <cmath>

#include "core/rotation.hpp"
#include "vision/core/heading/corridor_tracker.hpp"

namespace vpdr::vision {
namespace {

constexpr double kQuarter = 0.5 * kPi;
constexpr TimestampNs kPeriod = kNsPerSecond / 10;

double quarter_wrapped(double a) { return a - kQuarter * std::round(a / kQuarter); }

TEST(CorridorTracker, StaysContinuousThroughAFullTurnWithoutGyroTurn) {
  CorridorTracker tracker({});
  TimestampNs stamp = 0;
  for (double truth = 0.1; truth > -2.0 * kPi; truth -= 0.1) {
    stamp += kPeriod;
    const auto out = tracker.follow({stamp, quarter_wrapped(truth), 0.01});
    EXPECT_EQ(out.outcome, FrameOutcome::kFound);
    EXPECT_NEAR(out.heading_rad, truth, 1e-9);
  }
}

TEST(CorridorTracker, GyroTurnCarriesItOverATurnThatNoFrameSaw) {
  CorridorTracker tracker({});
  tracker.predict(GyroTurn{2.0, 0});
  EXPECT_NEAR(tracker.follow({kPeriod, 0.05, 0.01}).heading_rad, 0.05, 1e-12);
  // Four frames without a corridor while the walker turns right by 100 degrees in all.
  for (int i = 1; i <= 4; ++i) tracker.predict(GyroTurn{2.0 - i * to_radians(25.0), 0});
  const double truth = 0.05 - to_radians(100.0);
  const auto out = tracker.follow({6 * kPeriod, quarter_wrapped(truth), 0.01});
  EXPECT_EQ(out.outcome, FrameOutcome::kFound);
  EXPECT_NEAR(out.heading_rad, truth, 1e-9);
}

TEST(CorridorTracker, TurnsOfDifferentEpochsAreNotCompared) {
  CorridorTracker tracker({});
  tracker.predict(GyroTurn{0.0, 0});
  tracker.follow({kPeriod, 0.05, 0.01});
  tracker.predict(GyroTurn{1.7, 1});
  const auto out = tracker.follow({2 * kPeriod, 0.06, 0.01});
  EXPECT_EQ(out.outcome, FrameOutcome::kFound);
  EXPECT_NEAR(out.heading_rad, 0.06, 1e-12);
}

TEST(CorridorTracker, RateByHand) {
  CorridorTracker tracker({});
  EXPECT_FALSE(tracker.follow({kNsPerSecond, 0.10, 0.003}).rate);
  const auto out = tracker.follow({kNsPerSecond + kPeriod, 0.15, 0.004});
  ASSERT_TRUE(out.rate);
  EXPECT_NEAR(out.rate->rate_radps, 0.5, 1e-12);
  EXPECT_NEAR(out.rate->sigma_radps, 0.05, 1e-12);  // hypot(3, 4) mrad over 0.1 s
  EXPECT_EQ(out.rate->stamp_ns, kNsPerSecond + kPeriod);
  EXPECT_EQ(out.rate->interval_start_ns, kNsPerSecond);
}

TEST(CorridorTracker, RateIsContinuousWhereTheNearestDirectionChanges) {
  CorridorTracker tracker({});
  tracker.follow({kPeriod, 0.77, 0.01});
  // 0.80 rad is past 45 degrees: the frame now measures against the other direction.
  const auto out = tracker.follow({2 * kPeriod, 0.80 - kQuarter, 0.01});
  ASSERT_TRUE(out.rate);
  EXPECT_NEAR(out.rate->rate_radps, 0.3, 1e-9);
}

TEST(CorridorTracker, NoRateBetweenFramesTooFarApartOrTurnsTooFast) {
  TrackerConfig config;
  config.max_rate_interval_s = 0.5;
  CorridorTracker tracker(config);
  tracker.follow({0, 0.1, 0.01});
  EXPECT_FALSE(tracker.follow({kNsPerSecond, 0.1, 0.01}).rate);
  EXPECT_TRUE(tracker.follow({kNsPerSecond + kPeriod, 0.1, 0.01}).rate);
  EXPECT_FALSE(tracker.follow({kNsPerSecond + kPeriod + kPeriod / 100, 0.2, 0.01}).rate);
}

TEST(CorridorTracker, RefusesAHeadingFarFromTheInertialTurnUntilItPersists) {
  TrackerConfig config;
  config.frames_to_anchor = 5;
  CorridorTracker tracker(config);
  TimestampNs stamp = 0;
  const auto frame = [&](double yaw, double heading) {
    stamp += kPeriod;
    tracker.predict(GyroTurn{yaw, 1});
    return tracker.follow({stamp, heading, 0.01});
  };
  EXPECT_EQ(frame(0.0, 0.0).outcome, FrameOutcome::kFound);
  // One frame that mistakes something else for the corridor.
  EXPECT_EQ(frame(0.0, 0.6).outcome, FrameOutcome::kDisagrees);
  EXPECT_EQ(frame(0.0, 0.01).outcome, FrameOutcome::kFound);
  // A corridor that branches off at 40 degrees, walked along: heading 0 to it, 0.7 in all.
  for (int i = 0; i < 4; ++i) EXPECT_EQ(frame(0.7, 0.0).outcome, FrameOutcome::kDisagrees);
  const auto anchored = frame(0.7, 0.0);
  EXPECT_EQ(anchored.outcome, FrameOutcome::kFound);
  EXPECT_NEAR(anchored.heading_rad, 0.7 + 0.01, 1e-9);
  EXPECT_FALSE(anchored.rate);
  // From now on the new corridor is followed.
  EXPECT_NEAR(frame(0.72, 0.02).heading_rad, 0.73, 1e-9);
  EXPECT_TRUE(frame(0.72, 0.02).rate);
}

}  // namespace
}  // namespace vpdr::vision
