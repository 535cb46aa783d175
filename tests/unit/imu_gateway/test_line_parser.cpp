#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "core/rotation.hpp"
#include "imu_gateway/core/axis_map.hpp"
#include "imu_gateway/core/line_parser.hpp"

namespace vpdr::imu_gateway {
namespace {

constexpr const char* kImuColumns = "t_s,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps,temp_C";
constexpr const char* kMagColumns = "t_s,mx_G,my_G,mz_G";

LineParser board_parser() {
  return LineParser(
      {LineLayout::parse(kImuColumns).value(), LineLayout::parse(kMagColumns).value()});
}

TEST(LineParser, ReadsTheSeedBoardsLinesInSiUnits) {
  LineParser parser = board_parser();
  LineReadings out;
  ASSERT_EQ(parser.parse("0.5,1,0,-0.5,180,0,-90,24.7", out), LineVerdict::kReadings);
  ASSERT_TRUE(out.imu);
  EXPECT_EQ(out.board_stamp_ns, 500'000'000);
  EXPECT_DOUBLE_EQ(out.imu->specific_force_mps2.x(), kGravityMps2);
  EXPECT_DOUBLE_EQ(out.imu->specific_force_mps2.z(), -0.5 * kGravityMps2);
  EXPECT_DOUBLE_EQ(out.imu->angular_velocity_radps.x(), kPi);
  EXPECT_DOUBLE_EQ(out.imu->angular_velocity_radps.z(), -kPi / 2.0);
  EXPECT_FALSE(out.mag);

  ASSERT_EQ(parser.parse(" 0.5 , 0.241284,-0.337615,+0.25 ", out), LineVerdict::kReadings);
  ASSERT_TRUE(out.mag);
  EXPECT_FALSE(out.imu);
  EXPECT_NEAR(out.mag->field_ut.x(), 24.1284, 1e-12);
  EXPECT_DOUBLE_EQ(out.mag->field_ut.z(), 25.0);
}

TEST(LineParser, HeaderLineSetsTheLayout) {
  LineParser parser({});
  LineReadings out;
  EXPECT_EQ(parser.parse("1,2,3,4", out), LineVerdict::kUnknownLayout);
  EXPECT_EQ(parser.parse("# t_ms,mx_uT,my_uT,mz_uT", out), LineVerdict::kHeader);
  ASSERT_EQ(parser.parse("1,2,3,4", out), LineVerdict::kReadings);
  EXPECT_EQ(out.board_stamp_ns, 1'000'000);
  EXPECT_DOUBLE_EQ(out.mag->field_ut.y(), 3.0);
}

TEST(LineParser, BoardWithoutClockOrGyroscope) {
  LineParser parser({LineLayout::parse("ax_mps2,ay_mps2,az_mps2").value()});
  LineReadings out;
  ASSERT_EQ(parser.parse("0,0,9.8", out), LineVerdict::kReadings);
  EXPECT_FALSE(out.board_stamp_ns);
  EXPECT_FALSE(out.imu->has_angular_velocity);
}

TEST(LineParser, CountsWhatItCannotRead) {
  LineParser parser = board_parser();
  LineReadings out;
  for (const char* bad : {"0.5,1,0,-0.5,180,x,-90,24.7", "1,,2,3", "1e999,0,0,0", "1e30,1,1,1",
                          "nonsense", "0x10,1,1,1"}) {
    EXPECT_EQ(parser.parse(bad, out), LineVerdict::kMalformed) << bad;
  }
  EXPECT_EQ(parser.malformed(), 6U);
  EXPECT_EQ(parser.parse("1,2", out), LineVerdict::kUnknownLayout);
  EXPECT_EQ(parser.parse("   ", out), LineVerdict::kEmpty);
}

TEST(LineLayout, NamesTheUnknownColumn) {
  const auto layout = LineLayout::parse("t_s,ax_g,ay_g,az_furlong");
  ASSERT_FALSE(layout);
  EXPECT_THAT(layout.error().message, testing::HasSubstr("az_furlong"));
  EXPECT_FALSE(LineLayout::parse("t_s,ax_g,ay_g"));  // no whole sensor
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

TEST(LineParser, SurvivesCorruptedBytes) {
  std::mt19937 random(7);
  LineParser parser = board_parser();
  LineSplitter splitter;
  LineReadings out;
  int good = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string line = "0.5,1,0,-0.5,180,0,-90,24.7\n";
    if (i % 2 == 0) line[random() % line.size()] = static_cast<char>(random() % 256);
    splitter.feed(line, [&](std::string_view text) {
      good += parser.parse(text, out) == LineVerdict::kReadings ? 1 : 0;
    });
  }
  EXPECT_GT(good, 9000);  // every untouched line that does not follow a lost line end
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
