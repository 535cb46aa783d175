#include <gtest/gtest.h>

#include "core/last_step.hpp"

namespace vpdr {
namespace {

TEST(LastStep, TheBodyMovesOnByHalfAStepAtMost) {
  // Steps of 0.6 m twice a second.
  EXPECT_DOUBLE_EQ(beyond_last_step_m(0.0, 1.2, 0.6), 0.0);
  EXPECT_DOUBLE_EQ(beyond_last_step_m(0.1, 1.2, 0.6), 0.12);
  EXPECT_DOUBLE_EQ(beyond_last_step_m(0.25, 1.2, 0.6), 0.3);
  EXPECT_DOUBLE_EQ(beyond_last_step_m(0.7, 1.2, 0.6), 0.3);
}

TEST(LastStep, WhoeverStopsStandsWhereItLed) {
  EXPECT_DOUBLE_EQ(beyond_last_step_m(1.0, 1.2, 0.6), 0.15);
  EXPECT_DOUBLE_EQ(beyond_last_step_m(1.25, 1.2, 0.6), 0.0);
  EXPECT_DOUBLE_EQ(beyond_last_step_m(100.0, 1.2, 0.6), 0.0);
}

TEST(LastStep, NobodyMovesBack) {
  EXPECT_EQ(beyond_last_step_m(-0.2, 1.2, 0.6), 0.0);
  EXPECT_EQ(beyond_last_step_m(1.0, 0.0, 0.6), 0.0);
  EXPECT_EQ(beyond_last_step_m(1.0, 1.2, 0.0), 0.0);
}

}  // namespace
}  // namespace vpdr
