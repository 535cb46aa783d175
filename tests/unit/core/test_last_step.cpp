#include <gtest/gtest.h>

#include "core/last_step.hpp"

namespace vpdr {
namespace {

TEST(LastStep, TheBodyMovesOnByHalfAStepAtMost) {
  // Steps of 0.6 m twice a second.
  EXPECT_DOUBLE_EQ(beyond_last_step_m(0.0, 0.5, 0.6), 0.0);
  EXPECT_DOUBLE_EQ(beyond_last_step_m(0.1, 0.5, 0.6), 0.12);
  EXPECT_DOUBLE_EQ(beyond_last_step_m(0.25, 0.5, 0.6), 0.3);
  EXPECT_DOUBLE_EQ(beyond_last_step_m(0.7, 0.5, 0.6), 0.3);
}

TEST(LastStep, WhoeverStopsStandsShortOfWhereItLed) {
  EXPECT_DOUBLE_EQ(beyond_last_step_m(1.0, 0.5, 0.6), 0.5 * 0.3 - 0.5 * 0.36);
  EXPECT_FALSE(has_halted(1.2, 0.5));
  EXPECT_DOUBLE_EQ(beyond_last_step_m(1.25, 0.5, 0.6), -0.36);
  EXPECT_DOUBLE_EQ(beyond_last_step_m(100.0, 0.5, 0.6), -0.36);
  EXPECT_TRUE(has_halted(1.3, 0.5));
}

TEST(LastStep, NobodyMovesBeforeAStepOrWithoutOne) {
  EXPECT_EQ(beyond_last_step_m(-0.2, 0.5, 0.6), 0.0);
  EXPECT_EQ(beyond_last_step_m(1.0, 0.0, 0.6), 0.0);
  EXPECT_EQ(beyond_last_step_m(1.0, 0.5, 0.0), 0.0);
}

}  // namespace
}  // namespace vpdr
