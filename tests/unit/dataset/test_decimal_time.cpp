#include <gtest/gtest.h>

#include <random>

#include "dataset/decimal_time.hpp"

namespace vpdr::dataset {
namespace {

TEST(DecimalTime, KeepsEveryNanosecondOfAStampSince1970) {
  EXPECT_EQ(parse_decimal_seconds("1403636580.838555648"), 1403636580838555648);
  EXPECT_EQ(format_decimal_seconds(1403636580838555648), "1403636580.838555648");
}

TEST(DecimalTime, FillsShortFractionsAndRoundsLongOnes) {
  EXPECT_EQ(parse_decimal_seconds("12.5"), 12'500'000'000);
  EXPECT_EQ(parse_decimal_seconds("3"), 3'000'000'000);
  EXPECT_EQ(parse_decimal_seconds(".25"), 250'000'000);
  EXPECT_EQ(parse_decimal_seconds("0.0000000014"), 1);
  EXPECT_EQ(parse_decimal_seconds("0.9999999996"), 1'000'000'000);
}

TEST(DecimalTime, TakesNegativeTimesAndExponents) {
  EXPECT_EQ(parse_decimal_seconds("-1.25"), -1'250'000'000);
  EXPECT_EQ(parse_decimal_seconds("1.5e2"), 150'000'000'000);
  EXPECT_EQ(format_decimal_seconds(-1'250'000'000), "-1.250000000");
}

TEST(DecimalTime, RefusesWhatIsNoTime) {
  for (const char* text : {"", ".", "-", "1.2.3", "abc", "nan", "1,5", "99999999999", "1e300"}) {
    EXPECT_FALSE(parse_decimal_seconds(text).has_value()) << text;
  }
}

TEST(DecimalTime, FormatThenParseIsTheIdentity) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<TimestampNs> any(-4'000'000'000'000'000'000,
                                                 4'000'000'000'000'000'000);
  for (int i = 0; i < 1000; ++i) {
    const TimestampNs stamp = any(random);
    EXPECT_EQ(parse_decimal_seconds(format_decimal_seconds(stamp)), stamp);
  }
}

}  // namespace
}  // namespace vpdr::dataset
