#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include "fusion/core/history.hpp"

namespace vpdr::fusion {
namespace {

HeadingEstimate heading(double at_s, double yaw) {
  return {.stamp_ns = to_ns(at_s), .yaw_rad = yaw, .yaw_sigma_rad = 0.1};
}

StepEvent step(double at_s, std::uint32_t index) {
  StepEvent event;
  event.stamp_ns = to_ns(at_s);
  event.index = index;
  event.length_m = 0.7;
  event.length_sigma_m = 0.05;
  event.yaw_sigma_rad = 0.1;
  return event;
}

HeadingRate rate(double at_s, double value) { return {to_ns(at_s), to_ns(at_s - 0.1), value, 0.2}; }

/// Four seconds of all kinds, many stamps equal across kinds.
std::vector<Measurement> some_walk() {
  std::vector<Measurement> all;
  for (int i = 0; i <= 80; ++i) all.emplace_back(heading(0.05 * i, 0.02 * i));
  for (int i = 1; i <= 40; ++i) all.emplace_back(rate(0.1 * i, 0.4));
  for (int i = 1; i <= 8; ++i) all.emplace_back(step(0.5 * i, static_cast<std::uint32_t>(i)));
  return all;
}

TEST(Measurement, EqualStampsGoByKindThenByContent) {
  const Measurement of_rate = rate(1.0, 0.1);
  const Measurement of_heading = heading(1.0, 0.1);
  const Measurement of_step = step(1.0, 1);
  EXPECT_TRUE(comes_before(of_rate, of_heading));
  EXPECT_TRUE(comes_before(of_heading, of_step));
  EXPECT_FALSE(comes_before(of_step, of_rate));
  EXPECT_TRUE(comes_before(heading(1.0, 0.1), heading(1.0, 0.2)));
  EXPECT_FALSE(comes_before(of_heading, of_heading));
  EXPECT_TRUE(comes_before(step(0.9, 2), of_rate));
}

TEST(Measurement, StepActsAtItsMiddle) {
  StepEvent event = step(2.0, 1);
  event.frequency_hz = 2.0;
  EXPECT_EQ(stamp_of(event), to_ns(1.75));
}

TEST(History, EveryOrderOfArrivalGivesTheSameState) {
  std::vector<Measurement> walk = some_walk();
  History in_order{FusionConfig{}};
  std::sort(walk.begin(), walk.end(), comes_before);
  for (const Measurement& m : walk) ASSERT_EQ(in_order.insert(m), Refusal::kNone);
  EXPECT_EQ(in_order.reapplied(), 0U);

  std::mt19937_64 random(1);
  for (int run = 0; run < 20; ++run) {
    std::shuffle(walk.begin(), walk.end(), random);
    History shuffled{FusionConfig{}};
    for (const Measurement& m : walk) ASSERT_EQ(shuffled.insert(m), Refusal::kNone);
    EXPECT_GT(shuffled.reapplied(), 0U);
    EXPECT_EQ(shuffled.state().x, in_order.state().x);  // bit by bit
    EXPECT_EQ(shuffled.state().p, in_order.state().p);
    EXPECT_EQ(shuffled.state().stamp_ns, in_order.state().stamp_ns);
    EXPECT_EQ(shuffled.state().correction_rad, in_order.state().correction_rad);
    EXPECT_EQ(shuffled.state().headings.accepted, in_order.state().headings.accepted);
    EXPECT_EQ(shuffled.state().rates.resets, in_order.state().rates.resets);
  }
}

TEST(History, TheLastWordOnAStepReplacesTheTentativeOne) {
  StepEvent tentative = step(2.0, 1);
  tentative.status = StepStatus::kTentative;
  tentative.probability = 0.5;
  StepEvent confirmed = step(2.0, 1);
  confirmed.frequency_hz = 2.0;  // it is known by now, and moves the instant the step acts at
  StepEvent withdrawn = tentative;
  withdrawn.status = StepStatus::kWithdrawn;

  for (const auto& [last, x_m] : {std::pair(confirmed, 0.7), std::pair(withdrawn, 0.0)}) {
    std::vector<Measurement> all = {heading(1.0, 0.0), tentative, last, heading(3.0, 0.0)};
    std::optional<FilterState> first;
    std::mt19937_64 random(1);
    for (int run = 0; run < 20; ++run) {
      History history{FusionConfig{}};
      for (const Measurement& m : all) history.insert(m);
      if (!first) first = history.state();
      EXPECT_NEAR(history.state().x[kX], x_m, 1e-12);
      EXPECT_EQ(history.state().x, first->x) << "bit by bit, whatever came first";
      EXPECT_EQ(history.state().p, first->p);
      EXPECT_EQ(history.size(), 3U);
      EXPECT_EQ(history.state().steps, last.status == StepStatus::kConfirmed ? 1U : 0U);
      std::shuffle(all.begin(), all.end(), random);
    }
  }
}

TEST(History, TheFirstLastWordStands) {
  StepEvent confirmed = step(2.0, 1);
  StepEvent withdrawn = step(2.0, 1);
  withdrawn.status = StepStatus::kWithdrawn;
  StepEvent tentative = step(2.0, 1);
  tentative.status = StepStatus::kTentative;
  History history{FusionConfig{}};
  EXPECT_EQ(history.insert(heading(1.0, 0.0)), Refusal::kNone);
  EXPECT_EQ(history.insert(confirmed), Refusal::kNone);
  EXPECT_EQ(history.insert(withdrawn), Refusal::kDuplicate);
  EXPECT_EQ(history.insert(tentative), Refusal::kDuplicate);
  EXPECT_NEAR(history.state().x[kX], 0.7, 1e-12);
}

TEST(History, SecondCopyIsRefused) {
  History history{FusionConfig{}};
  EXPECT_EQ(history.insert(heading(1.0, 0.1)), Refusal::kNone);
  EXPECT_EQ(history.insert(step(1.2, 1)), Refusal::kNone);
  EXPECT_EQ(history.insert(heading(1.0, 0.1)), Refusal::kDuplicate);
  EXPECT_EQ(history.size(), 2U);
}

TEST(History, OlderThanWhatIsKeptIsRefused) {
  History history{FusionConfig{}};
  for (int i = 0; i < 20; ++i) ASSERT_EQ(history.insert(heading(i, 0.0)), Refusal::kNone);
  const FilterState before = history.state();
  history.forget_before(to_ns(15.0));
  EXPECT_EQ(history.size(), 5U);
  EXPECT_EQ(history.state().x, before.x);
  EXPECT_EQ(history.insert(step(13.0, 1)), Refusal::kBackwardInTime);
  EXPECT_EQ(history.insert(step(14.5, 1)), Refusal::kNone);  // after the newest that was dropped
  EXPECT_EQ(history.state().steps, 1U);
}

TEST(History, FullRingDropsTheOldest) {
  FusionConfig config;
  config.history.capacity = 4;
  History history(config);
  for (int i = 1; i <= 10; ++i) ASSERT_EQ(history.insert(heading(i, 0.0)), Refusal::kNone);
  EXPECT_EQ(history.size(), 4U);
  EXPECT_EQ(history.insert(step(6.5, 1)), Refusal::kBackwardInTime);
  EXPECT_EQ(history.insert(step(7.5, 2)), Refusal::kNone);
  EXPECT_EQ(history.state().steps, 1U);
  // None was lost: the first heading was taken, nine and the step's direction were weighed.
  EXPECT_EQ(history.state().headings.accepted, 10U);
}

}  // namespace
}  // namespace vpdr::fusion
