#include <gtest/gtest.h>

#include <cmath>

#include "vpdr/board/stream_statistics.hpp"

namespace vpdr::tool {
namespace {

TEST(StreamStatistics, ByHand) {
  StreamStatistics stream;
  // Intervals of 9, 11 and 10 ms; arrivals 1, 3, 1 and 3 ms late; two samples lost.
  stream.add(0, 1'000'000, 0, 9.0);
  stream.add(9'000'000, 12'000'000, 0, 11.0);
  stream.add(20'000'000, 21'000'000, 2, 9.0);
  stream.add(30'000'000, 33'000'000, 0, 11.0);
  const StreamFigures figures = stream.take();
  EXPECT_EQ(figures.samples, 4U);
  EXPECT_DOUBLE_EQ(figures.rate_hz, 100.0);
  EXPECT_NEAR(figures.stamp_jitter_ms, std::sqrt(2.0 / 3.0), 1e-9);
  EXPECT_NEAR(figures.arrival_jitter_ms, 1.0, 1e-9);
  EXPECT_DOUBLE_EQ(figures.longest_gap_ms, 11.0);
  EXPECT_EQ(figures.lost, 2U);
  EXPECT_DOUBLE_EQ(figures.length_mean, 10.0);
  EXPECT_DOUBLE_EQ(figures.length_sigma, 1.0);
}

TEST(StreamStatistics, PeriodsFollowOnFromOneAnother) {
  StreamStatistics stream;
  stream.add(0, 0, 0, 1.0);
  EXPECT_EQ(stream.take().rate_hz, 0.0) << "one sample has no rate";
  stream.add(20'000'000, 20'000'000, 0, 1.0);
  EXPECT_DOUBLE_EQ(stream.take().rate_hz, 50.0);
  EXPECT_EQ(stream.take().samples, 0U);
}

}  // namespace
}  // namespace vpdr::tool
