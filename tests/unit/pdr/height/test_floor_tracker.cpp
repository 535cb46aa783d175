#include <gtest/gtest.h>

#include "pdr/core/height/floor_tracker.hpp"

namespace vpdr::pdr {
namespace {

/// A walker on the way, half a second at a time.
class Way {
 public:
  explicit Way(const FloorConfig& config = {}) : tracker(config) {}

  void level(double seconds) { go(seconds, 0.0, 0.02, true); }
  void climb(double seconds, double speed_mps, bool walking = true) {
    go(seconds, speed_mps, 0.97, walking);
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) tracker.add_step();
  }

  FloorTracker tracker;

 private:
  void go(double seconds, double speed_mps, double climbing, bool walking) {
    for (int i = 0; i < static_cast<int>(2.0 * seconds); ++i) {
      now_ += to_ns(0.5);
      height_ += 0.5 * speed_mps;
      tracker.add({now_, height_, speed_mps, climbing, walking});
    }
  }
  TimestampNs now_ = 0;
  double height_ = 0.0;
};

TEST(FloorTracker, AFloorWithALandingIsOneFloor) {
  Way way;
  way.level(20.0);
  way.climb(5.0, 0.3);
  EXPECT_EQ(way.tracker.state(), VerticalState::kStairsUp);
  way.steps(9);
  way.level(3.0);
  EXPECT_EQ(way.tracker.state(), VerticalState::kLevel);
  way.climb(5.0, 0.3);
  way.steps(9);
  EXPECT_EQ(way.tracker.floor(), 0);  // not before it is sure to have ended
  way.level(8.0);
  EXPECT_EQ(way.tracker.floor(), 1);
  EXPECT_EQ(way.tracker.changes(), 1);
  ASSERT_TRUE(way.tracker.last_change());
  EXPECT_NEAR(way.tracker.last_change()->gained_m, 3.0, 1e-9);
  EXPECT_EQ(way.tracker.last_change()->begin_ns, to_ns(20.5));
  EXPECT_EQ(way.tracker.last_change()->end_ns, to_ns(33.0));
  EXPECT_TRUE(way.tracker.last_change()->by_stairs);
}

TEST(FloorTracker, HalfAStoreyWaitsForTheOtherHalf) {
  Way way;
  way.level(20.0);
  way.climb(5.0, 0.3);
  way.level(30.0);  // a rest on the landing
  EXPECT_EQ(way.tracker.floor(), 0);
  way.climb(5.0, 0.3);
  way.level(30.0);
  EXPECT_EQ(way.tracker.floor(), 1);
}

TEST(FloorTracker, DownByLift) {
  Way way;
  way.level(20.0);
  way.climb(6.5, -1.5, false);
  EXPECT_EQ(way.tracker.state(), VerticalState::kLiftDown);
  way.level(10.0);
  EXPECT_EQ(way.tracker.floor(), -3);  // 9.75 m
  EXPECT_FALSE(way.tracker.last_change()->by_stairs);
}

TEST(FloorTracker, ARampIsTheSameFloor) {
  Way way;
  for (int i = 0; i < 20; ++i) {
    way.climb(2.0, 0.25);
    way.level(10.0);
  }
  EXPECT_EQ(way.tracker.changes(), 0);
}

TEST(FloorTracker, LearnsTheHeightOfAStorey) {
  Way way({.floor_height_m = 3.2, .settle_s = 6.0});
  for (int i = 0; i < 3; ++i) {
    way.climb(10.0, 0.4);
    way.level(10.0);
  }
  EXPECT_EQ(way.tracker.floor(), 3);
  EXPECT_NEAR(way.tracker.floor_height_m(), (3.2 + 3.0 * 4.0) / 4.0, 1e-9);
  // 15 m are four storeys of 3.8 m, and would be five of 3.2 m.
  way.climb(10.0, -1.5, false);
  way.level(10.0);
  EXPECT_EQ(way.tracker.floor(), -1);
}

TEST(FloorTracker, NamesItsStates) {
  EXPECT_STREQ(name_of(VerticalState::kLevel), "level");
  EXPECT_STREQ(name_of(VerticalState::kStairsUp), "stairs up");
  EXPECT_STREQ(name_of(VerticalState::kLiftDown), "lift down");
}

}  // namespace
}  // namespace vpdr::pdr
