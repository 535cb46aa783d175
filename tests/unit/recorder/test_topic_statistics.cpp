#include <gtest/gtest.h>

#include "recorder/core/header_stamp.hpp"
#include "recorder/core/topic_statistics.hpp"

namespace vpdr::recorder {
namespace {

TEST(TopicStatistics, CountsByHand) {
  TopicStatistics s;
  EXPECT_EQ(s.rate_hz(), 0.0);
  s.take(kNsPerSecond, 100, 0);
  EXPECT_EQ(s.rate_hz(), 0.0) << "one sample has no rate";
  s.take(3 * kNsPerSecond, 50, 7);
  s.take(2 * kNsPerSecond, 50, 0);  // out of order: times span all
  EXPECT_EQ(s.received, 3U);
  EXPECT_EQ(s.lost, 7U);
  EXPECT_EQ(s.bytes, 200U);
  EXPECT_DOUBLE_EQ(s.rate_hz(), 1.0) << "two intervals in two seconds";
}

TEST(TopicStatistics, SumSpansBoth) {
  TopicStatistics a;
  a.take(10, 1, 0);
  TopicStatistics b;
  b.take(5, 2, 3);
  b.before = 4;
  b.written = 1;
  TopicStatistics sum;
  sum += a;
  sum += b;
  EXPECT_EQ(sum.received, 2U);
  EXPECT_EQ(sum.lost, 3U);
  EXPECT_EQ(sum.before, 4U);
  EXPECT_EQ(sum.written, 1U);
  EXPECT_EQ(sum.bytes, 3U);
  EXPECT_EQ(sum.first_ns, 5);
  EXPECT_EQ(sum.last_ns, 10);
}

TEST(RecentGrowth, IsOverTenReports) {
  RecentGrowth growth;
  EXPECT_EQ(growth.update(3), 3U);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(growth.update(3), 3U);
  EXPECT_EQ(growth.update(3), 0U) << "the growth is ten reports old";
  EXPECT_EQ(growth.update(5), 2U);
}

std::vector<std::byte> payload(std::initializer_list<int> values) {
  std::vector<std::byte> bytes;
  for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
  return bytes;
}

TEST(HeaderStamp, LittleEndianByHand) {
  EXPECT_EQ(header_stamp(payload({0, 1, 0, 0, 2, 0, 0, 0, 0x00, 0xCA, 0x9A, 0x3B})),
            3 * kNsPerSecond)
      << "0x3B9ACA00 is a thousand million";
}

TEST(HeaderStamp, BigEndianByHand) {
  EXPECT_EQ(header_stamp(payload({0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 5})), 2 * kNsPerSecond + 5);
}

TEST(HeaderStamp, BeforeTheEpoch) {
  EXPECT_EQ(header_stamp(payload({0, 1, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 1, 0, 0, 0})),
            -kNsPerSecond + 1);
}

TEST(HeaderStamp, NothingOfWhatIsShortOrOtherwiseEncoded) {
  EXPECT_FALSE(header_stamp({}));
  EXPECT_FALSE(header_stamp(payload({0, 1, 0, 0, 2, 0, 0, 0, 0, 0, 0})));
  EXPECT_FALSE(header_stamp(payload({0, 3, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}))) << "parameter list";
  EXPECT_FALSE(header_stamp(payload({1, 1, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0})));
}

}  // namespace
}  // namespace vpdr::recorder
