#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/axis_map.hpp"
#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "imu_gateway/core/line_parser.hpp"

namespace vpdr::imu_gateway {
namespace {

constexpr const char* kImuColumns = "t_s,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps,temp_C";
constexpr const char* kMagColumns = "t_s,mx_G,my_G,mz_G";

LineFormat format_of(const std::vector<std::string>& columns) {
  LineFormat format;
  for (const std::string& names : columns)
    format.layouts.push_back(LineLayout::parse(names).value());
  return format;
}

LineParser board_parser() { return LineParser(format_of({kImuColumns, kMagColumns})); }

TEST(LineParser, ReadsTheSeedBoardsLinesInSiUnits) {
  LineParser parser = board_parser();
  BoardReadings out;
  ASSERT_EQ(parser.parse("0.5,1,0,-0.5,180,0,-90,24.7", out), LineVerdict::kReadings);
  ASSERT_TRUE(out.specific_force_mps2);
  EXPECT_EQ(out.board_stamp_ns, 500'000'000);
  EXPECT_DOUBLE_EQ(out.specific_force_mps2->x(), kGravityMps2);
  EXPECT_DOUBLE_EQ(out.specific_force_mps2->z(), -0.5 * kGravityMps2);
  EXPECT_DOUBLE_EQ(out.angular_velocity_radps->x(), kPi);
  EXPECT_DOUBLE_EQ(out.angular_velocity_radps->z(), -kPi / 2.0);
  EXPECT_EQ(out.temperature_c, 24.7);
  EXPECT_FALSE(out.field_ut);

  ASSERT_EQ(parser.parse(" 0.5 , 0.241284,-0.337615,+0.25 ", out), LineVerdict::kReadings);
  ASSERT_TRUE(out.field_ut);
  EXPECT_FALSE(out.specific_force_mps2);
  EXPECT_NEAR(out.field_ut->x(), 24.1284, 1e-12);
  EXPECT_DOUBLE_EQ(out.field_ut->z(), 25.0);
}

TEST(LineParser, HeaderLineSetsTheLayout) {
  LineParser parser({});
  BoardReadings out;
  EXPECT_EQ(parser.parse("1,2,3,4", out), LineVerdict::kUnknownLayout);
  EXPECT_EQ(parser.parse("# t_ms,mx_uT,my_uT,mz_uT", out), LineVerdict::kHeader);
  ASSERT_EQ(parser.parse("1,2,3,4", out), LineVerdict::kReadings);
  EXPECT_EQ(out.board_stamp_ns, 1'000'000);
  EXPECT_EQ(out.clock_wraps_at_ns, (TimestampNs{1} << 32) * 1'000'000);
  EXPECT_DOUBLE_EQ(out.field_ut->y(), 3.0);
  // Another header of as many columns takes its place.
  EXPECT_EQ(parser.parse("t_ms,mx_mG,my_mG,mz_mG", out), LineVerdict::kHeader);
  ASSERT_EQ(parser.parse("1,2,3,4", out), LineVerdict::kReadings);
  EXPECT_DOUBLE_EQ(out.field_ut->y(), 0.3);
}

TEST(LineParser, BoardWithoutClockOrGyroscope) {
  LineParser parser(format_of({"ax_mps2,ay_mps2,az_mps2"}));
  BoardReadings out;
  ASSERT_EQ(parser.parse("0,0,9.8", out), LineVerdict::kReadings);
  EXPECT_FALSE(out.board_stamp_ns);
  EXPECT_FALSE(out.angular_velocity_radps);
}

TEST(LineParser, ScalesRawCountsAndTurnsSigns) {
  LineParser parser(format_of({"-ax_g/16384,ay_g*0.5,az_mg,gx_dps/131,gy_dps,gz_dps,skip_it"}));
  BoardReadings out;
  ASSERT_EQ(parser.parse("16384,2,1000,-131,0,0,anything", out), LineVerdict::kReadings);
  EXPECT_DOUBLE_EQ(out.specific_force_mps2->x(), -kGravityMps2);
  EXPECT_DOUBLE_EQ(out.specific_force_mps2->y(), kGravityMps2);
  EXPECT_DOUBLE_EQ(out.specific_force_mps2->z(), kGravityMps2);
  EXPECT_DOUBLE_EQ(out.angular_velocity_radps->x(), -kPi / 180.0);
}

TEST(LineParser, TellsKindsOfLineApartByTheirTexts) {
  LineParser parser(format_of({"=A,t_us,ax_g,ay_g,az_g", "=M,t_us,mx_uT,my_uT,mz_uT"}));
  BoardReadings out;
  ASSERT_EQ(parser.parse("M,5,1,2,3", out), LineVerdict::kReadings);
  EXPECT_TRUE(out.field_ut && !out.specific_force_mps2);
  ASSERT_EQ(parser.parse("A,5,1,2,3", out), LineVerdict::kReadings);
  EXPECT_TRUE(out.specific_force_mps2 && !out.field_ut);
  EXPECT_EQ(parser.parse("Q,5,1,2,3", out), LineVerdict::kMalformed);
}

struct SeparatedLine {
  Separator separator;
  const char* line;
};

class Separators : public testing::TestWithParam<SeparatedLine> {};

TEST_P(Separators, GiveTheSameReading) {
  LineFormat format = format_of({"t_s,mx_uT,my_uT,mz_uT"});
  format.separator = GetParam().separator;
  LineParser parser(format);
  BoardReadings out;
  ASSERT_EQ(parser.parse(GetParam().line, out), LineVerdict::kReadings) << GetParam().line;
  EXPECT_EQ(out.board_stamp_ns, 500'000'000);
  EXPECT_EQ(*out.field_ut, Eigen::Vector3d(1.25, -2.0, 3.0));
}

INSTANTIATE_TEST_SUITE_P(All, Separators,
                         testing::Values(SeparatedLine{Separator::kAuto, "0.5,1.25,-2,3"},
                                         SeparatedLine{Separator::kAuto, "0.5, 1.25, -2, 3"},
                                         SeparatedLine{Separator::kAuto, "0,5; 1,25; -2,0; 3"},
                                         SeparatedLine{Separator::kAuto, "0.5\t1.25\t-2\t3"},
                                         SeparatedLine{Separator::kAuto, "0.5   1.25 -2\t 3"},
                                         SeparatedLine{Separator::kSpace, " 0,5 1,25 -2,0 3 "},
                                         SeparatedLine{Separator::kTab, "0.5\t 1.25\t-2\t3"},
                                         SeparatedLine{Separator::kComma, "0.5,1.25,-2,3"},
                                         SeparatedLine{Separator::kSemicolon, "0.5;1.25;-2;3"}));

TEST(LineParser, ChecksumOnceSeenIsAskedFor) {
  LineParser parser(format_of({"t_s,mx_uT,my_uT,mz_uT"}));
  BoardReadings out;
  EXPECT_EQ(parser.parse("1,2,3,4", out), LineVerdict::kReadings);
  // '1'^','^'2'^','^'3'^','^'4' = 0x28 by hand.
  EXPECT_EQ(parser.parse("$1,2,3,4*28", out), LineVerdict::kReadings);
  EXPECT_EQ(parser.parse("$1,2,3,5*28", out), LineVerdict::kMalformed);
  EXPECT_EQ(parser.parse("1,2,3,4", out), LineVerdict::kMalformed);
  EXPECT_EQ(parser.parse("1,2,3,4*28", out), LineVerdict::kReadings);
}

TEST(LineParser, NoiseThatNamesColumnsDoesNotFillTheMemory) {
  LineParser parser({});
  BoardReadings out;
  int adopted = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::string header = "=A" + std::to_string(i) + ",p_Pa";
    adopted += parser.parse(header, out) == LineVerdict::kHeader ? 1 : 0;
  }
  EXPECT_EQ(adopted, 32);
}

TEST(LineParser, SaysWhatItCannotRead) {
  LineParser parser = board_parser();
  BoardReadings out;
  for (const char* bad : {"0.5,1,0,-0.5,180,x,-90,24.7", "1,,2,3", "1e999,0,0,0", "1e30,1,1,1",
                          "nonsense", "0x10,1,1,1", "nan,1,1,1", "-inf,1,1,1"}) {
    EXPECT_EQ(parser.parse(bad, out), LineVerdict::kMalformed) << bad;
  }
  EXPECT_EQ(parser.parse("1,2", out), LineVerdict::kUnknownLayout);
  EXPECT_EQ(parser.parse("   ", out), LineVerdict::kEmpty);
}

TEST(LineParser, ReadsTheMessagesOfXioBoards) {
  LineParser parser(xio_format(50.0));
  BoardReadings out;
  ASSERT_EQ(parser.parse("I,1000000,180.0,0.0,-90.0,0.0,0.0,1.0", out), LineVerdict::kReadings);
  EXPECT_EQ(out.board_stamp_ns, kNsPerSecond);
  EXPECT_DOUBLE_EQ(out.angular_velocity_radps->x(), kPi);
  EXPECT_DOUBLE_EQ(out.specific_force_mps2->z(), kGravityMps2);
  ASSERT_EQ(parser.parse("M,1000000,1.0,0.0,-0.5", out), LineVerdict::kReadings);
  EXPECT_EQ(*out.field_ut, Eigen::Vector3d(50.0, 0.0, -25.0));
  ASSERT_EQ(parser.parse("T,1000000,25.5", out), LineVerdict::kReadings);
  EXPECT_EQ(out.temperature_c, 25.5);
  EXPECT_EQ(parser.parse("Q,1000000,1.0,0.0,0.0,0.0", out), LineVerdict::kIgnored);
  EXPECT_EQ(parser.parse("N,1000000,Button pressed", out), LineVerdict::kIgnored);
  EXPECT_EQ(parser.parse("I,1000000,180.0,0.0,-90.0,0.0,x,1.0", out), LineVerdict::kMalformed);
  EXPECT_EQ(parser.parse("{\"ping\":null}", out), LineVerdict::kMalformed);
  EXPECT_EQ(parser.parse("N,1,x*07", out), LineVerdict::kIgnored);  // no checksum in this protocol
  EXPECT_EQ(parser.parse("T,1000000,25.5", out), LineVerdict::kReadings);
  EXPECT_EQ(parser.parse("1000000,1.0,0.0,-0.5", out), LineVerdict::kMalformed);
}

TEST(LineLayout, NamesTheUnknownColumn) {
  const auto layout = LineLayout::parse("t_s,ax_g,ay_g,az_furlong");
  ASSERT_FALSE(layout);
  EXPECT_THAT(layout.error().message, testing::HasSubstr("az_furlong"));
  EXPECT_FALSE(LineLayout::parse("t_s,ax_g,ay_g"));  // no whole sensor
  EXPECT_FALSE(LineLayout::parse("ax_g/0,ay_g,az_g"));
  EXPECT_FALSE(LineLayout::parse(""));
}

TEST(LineSplitter, FindsLinesAcrossReadsAndDropsOverlongOnes) {
  LineSplitter splitter(8);
  std::vector<std::string> lines;
  const auto keep = [&lines](std::string_view line) { lines.emplace_back(line); };
  splitter.feed("ab", keep);
  splitter.feed("c\r\nd", keep);
  splitter.feed("ef\n123456789012\nok\n", keep);
  EXPECT_EQ(lines, (std::vector<std::string>{"abc", "def", "ok"}));
  EXPECT_EQ(splitter.overlong_lines(), 1U);
}

TEST(AxisMap, TurnsAFlatPhoneToForwardLeftUp) {
  const auto map = parse_axis_map("+y,-x,+z", false);
  ASSERT_TRUE(map);
  EXPECT_EQ(map.value() * Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(2, -1, 3));
}

TEST(AxisMap, RefusesWhatIsNoRotation) {
  EXPECT_FALSE(parse_axis_map("+x,+y,-z", false));
  EXPECT_TRUE(parse_axis_map("+x,+y,-z", true));
  EXPECT_FALSE(parse_axis_map("+x,+x,+z", true));
  EXPECT_FALSE(parse_axis_map("+x,+y", true));
  EXPECT_FALSE(parse_axis_map("+x,+y,+z,+x", true));
  EXPECT_FALSE(parse_axis_map("+x,+y,up", true));
}

}  // namespace
}  // namespace vpdr::imu_gateway
