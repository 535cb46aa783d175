#include <gtest/gtest.h>

#include "dds/detail/deadline_watch.hpp"

namespace vpdr::dds::detail {
namespace {

using namespace std::chrono_literals;

const DeadlineWatch::Time kStart{100s};

TEST(DeadlineWatch, NothingIsMissedBeforeTheFirstSample) {
  const DeadlineWatch watch(0.1);
  EXPECT_EQ(watch.missed(kStart + 10s), 0U);
  EXPECT_FALSE(watch.next(kStart).has_value());
}

TEST(DeadlineWatch, EachDeadlineWithoutASampleCountsOnce) {
  DeadlineWatch watch(0.1);
  watch.see(kStart);
  EXPECT_EQ(watch.missed(kStart + 99ms), 0U);
  EXPECT_EQ(watch.next(kStart + 50ms), kStart + 100ms);
  EXPECT_EQ(watch.missed(kStart + 250ms), 2U);
  EXPECT_EQ(watch.next(kStart + 250ms), kStart + 300ms);
  watch.see(kStart + 350ms);  // three were missed before it
  EXPECT_EQ(watch.missed(kStart + 449ms), 3U);
  EXPECT_EQ(watch.missed(kStart + 450ms), 4U);
}

TEST(DeadlineWatch, SamplesInTimeMissNone) {
  DeadlineWatch watch(0.1);
  for (int i = 0; i < 100; ++i) watch.see(kStart + i * 99ms);
  EXPECT_EQ(watch.missed(kStart + 99 * 99ms), 0U);
}

TEST(DeadlineWatch, NoDeadlineNoSilence) {
  DeadlineWatch watch(0.0);
  watch.see(kStart);
  EXPECT_EQ(watch.missed(kStart + 10s), 0U);
  EXPECT_FALSE(watch.next(kStart).has_value());
}

}  // namespace
}  // namespace vpdr::dds::detail
