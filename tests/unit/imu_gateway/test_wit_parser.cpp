#include <gtest/gtest.h>

#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "imu_gateway/core/wit_parser.hpp"
#include "tests/support/boards.hpp"

namespace vpdr::imu_gateway {
namespace {

using testing_support::Measurement;
using testing_support::wit_bytes;
using testing_support::wit_frame;

std::vector<BoardReadings> parse(WitParser& parser, std::string_view bytes) {
  std::vector<BoardReadings> out;
  parser.feed(bytes, out);
  return out;
}

TEST(WitParser, ReadsAFrameByHand) {
  // The data sheet's layout: ax = 0x0800 = 2048 counts of 16 g / 32768 = 1 g, az = -1 g; rate
  // x = 0x4000 = 1000 deg/s. Sums: 0x55+0x51+0x08+0x00+0xF8 = 0x1A6; 0x55+0x52+0x40 = 0xE7.
  const std::string bytes(
      "\x55\x51\x00\x08\x00\x00\x00\xF8\x00\x00\xA6\x55\x52\x00\x40\x00\x00\x00\x00\x00\x00\xE7",
      22);
  WitParser parser({});
  const auto out = parse(parser, bytes);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_TRUE(out[0].specific_force_mps2->isApprox(Eigen::Vector3d(1, 0, -1) * kGravityMps2));
  EXPECT_DOUBLE_EQ(out[0].angular_velocity_radps->x(), 1000.0 * kPi / 180.0);
  EXPECT_FALSE(out[0].board_stamp_ns);
}

TEST(WitParser, ReadsFieldPressureAndTemperatureInTheBoardsRanges) {
  WitOptions options;
  options.acceleration_range_g = 8.0;
  options.rate_range_dps = 500.0;
  WitParser parser(options);
  const auto out =
      parse(parser, wit_frame(0x51, {16384, 0, 0, 2512}) + wit_frame(0x52, {0, 16384, 0, 0}) +
                        wit_frame(0x53, {1, 2, 3, 4}) + wit_frame(0x54, {-300, 10, 0, 0}) +
                        // 101325 = 0x00018BCD
                        wit_frame(0x56, {static_cast<std::int16_t>(0x8BCD), 1, 0, 0}));
  ASSERT_EQ(out.size(), 3U);
  EXPECT_DOUBLE_EQ(out[0].specific_force_mps2->x(), 4.0 * kGravityMps2);
  EXPECT_DOUBLE_EQ(out[0].angular_velocity_radps->y(), 250.0 * kPi / 180.0);
  EXPECT_DOUBLE_EQ(*out[0].temperature_c, 25.12);
  EXPECT_DOUBLE_EQ(out[1].field_ut->x(), -30.0);
  EXPECT_DOUBLE_EQ(*out[2].pressure_pa, 101325.0);
}

TEST(WitParser, TakesTheBoardsTimeForTheWholeSet) {
  // 2024-02-29 12:34:56.789: month and year in the low bytes first.
  const std::string time = wit_frame(
      0x50, {static_cast<std::int16_t>(24 | (2 << 8)), static_cast<std::int16_t>(29 | (12 << 8)),
             static_cast<std::int16_t>(34 | (56 << 8)), 789});
  WitParser parser({});
  const auto out = parse(parser, time + wit_bytes({}));
  ASSERT_EQ(out.size(), 2U);
  EXPECT_EQ(out[0].board_stamp_ns, 1'709'210'096'789'000'000);
  EXPECT_EQ(out[1].board_stamp_ns, out[0].board_stamp_ns);
  // A set whose time was damaged has none, and is no reading of a board that sends times.
  std::string damaged = time;
  damaged[4] = 30;
  EXPECT_TRUE(parse(parser, damaged + wit_bytes({})).empty());
  EXPECT_EQ(parser.counts().incomplete, 2U);
  EXPECT_EQ(parse(parser, time + wit_bytes({})).size(), 2U);
  // A board that was told to send times no more is read without them.
  std::size_t untimed = 0;
  for (int i = 0; i < 20; ++i) untimed += parse(parser, wit_bytes({})).size();
  EXPECT_EQ(untimed, 26U);  // seven sets of two readings are waited for in vain
}

TEST(WitParser, TakesBytesInPiecesOfAnySize) {
  std::string stream;
  for (int i = 0; i < 50; ++i) {
    stream += wit_bytes({.acceleration_g = {0.001 * i, 0.0, 1.0}, .rate_dps = {1.0 * i, 0, 0}});
  }
  WitParser whole({});
  const auto expected = parse(whole, stream);
  EXPECT_EQ(expected.size(), 100U);
  for (const std::size_t piece : {1U, 2U, 3U, 7U, 10U, 11U, 12U, 100U}) {
    WitParser parser({});
    std::vector<BoardReadings> out;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      parser.feed(std::string_view(stream).substr(at, piece), out);
    }
    ASSERT_EQ(out.size(), expected.size()) << piece;
    for (std::size_t i = 0; i < out.size(); ++i) {
      EXPECT_EQ(out[i].angular_velocity_radps, expected[i].angular_velocity_radps);
      EXPECT_EQ(out[i].field_ut, expected[i].field_ut);
    }
    EXPECT_EQ(parser.counts().malformed, 0U);
  }
}

TEST(WitParser, NeverJoinsTheHalvesOfTwoSets) {
  const std::string first = wit_bytes({.acceleration_g = {0.5, 0, 1}, .rate_dps = {10, 0, 0}});
  const std::string second = wit_bytes({.acceleration_g = {0.7, 0, 1}, .rate_dps = {20, 0, 0}});
  std::string stream = first + second;
  stream[14] ^= 0x10;                // the first set's rate
  stream[first.size() + 5] ^= 0x10;  // the second set's acceleration
  WitParser parser({});
  const auto out = parse(parser, stream);
  ASSERT_EQ(out.size(), 2U);  // the fields of both
  EXPECT_TRUE(out[0].field_ut && out[1].field_ut);
  EXPECT_EQ(parser.counts().malformed, 2U);
  EXPECT_EQ(parser.counts().incomplete, 1U);
}

TEST(WitParser, EveryLostOrDoubledByteCostsItsFrameOnly) {
  const Measurement m{.acceleration_g = {0.33, -0.21, 0.9}, .rate_dps = {11, -7, 3}};
  const std::string set = wit_bytes(m);
  WitParser reference({});
  const auto good = parse(reference, set).front();
  for (std::size_t at = 0; at < set.size(); ++at) {
    for (const bool doubled : {false, true}) {
      std::string damaged = set;
      if (doubled) {
        damaged.insert(at, 1, set[at]);
      } else {
        damaged.erase(at, 1);
      }
      WitParser parser({});
      const auto out = parse(parser, set + damaged + set + set);
      // Six readings are untouched, and whichever of the damaged set is left is right.
      EXPECT_GE(out.size(), 6U) << at << doubled;
      for (const auto& readings : out) {
        if (!readings.specific_force_mps2) continue;
        EXPECT_EQ(readings.specific_force_mps2, good.specific_force_mps2) << at << doubled;
        EXPECT_EQ(readings.angular_velocity_radps, good.angular_velocity_radps) << at << doubled;
      }
    }
  }
}

}  // namespace
}  // namespace vpdr::imu_gateway
