#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "imu_gateway/core/link_watch.hpp"
#include "imu_gateway/core/make_parser.hpp"

namespace vpdr::imu_gateway {
namespace {

using testing::HasSubstr;

constexpr TimestampNs kBegin = 1'000 * kNsPerSecond;

/// A port that was opened at kBegin, and text lines through it.
class LinkWatchTest : public testing::Test {
 protected:
  void SetUp() override { watch_.open(kBegin); }
  /// These bytes each half second, for ten seconds.
  void send(const std::string& bytes) {
    for (int i = 1; i <= 20; ++i) {
      now_ = kBegin + i * kNsPerSecond / 2;
      std::vector<BoardReadings> readings;
      parser_->feed(bytes, readings);
      watch_.see_bytes(bytes.size(), now_);
      for (const auto& r : readings) watch_.see_reading(r.specific_force_mps2.has_value(), now_);
    }
  }
  std::optional<LinkTrouble> trouble() { return watch_.trouble("/dev/ttyUSB0", *parser_, now_); }

  LinkWatch watch_;
  std::unique_ptr<BoardParser> parser_ = make_parser({});
  TimestampNs now_ = kBegin;
};

TEST_F(LinkWatchTest, NothingIsWrongInTheFirstSeconds) {
  now_ = kBegin + 2 * kNsPerSecond;
  EXPECT_FALSE(trouble().has_value());
}

TEST_F(LinkWatchTest, ABoardThatSendsIsRight) {
  send("t_ms,ax_g,ay_g,az_g\n1,0,0,1\n");
  EXPECT_FALSE(trouble().has_value());
}

TEST_F(LinkWatchTest, NamesAMuteBoard) {
  send("");
  ASSERT_TRUE(trouble().has_value());
  EXPECT_EQ(trouble()->reason, "/dev/ttyUSB0 sends nothing");
  EXPECT_THAT(trouble()->remedy, HasSubstr("port"));
}

TEST_F(LinkWatchTest, ShowsALineWhoseColumnsNobodyNamed) {
  send("MPU6050 found\n10,0.01,-0.02,1.00\n");
  ASSERT_TRUE(trouble().has_value());
  EXPECT_THAT(trouble()->reason, HasSubstr("`10,0.01,-0.02,1.00`"));
  EXPECT_THAT(trouble()->remedy, HasSubstr("imu_gateway.serial.lines"));
}

TEST_F(LinkWatchTest, NamesTheSpeedWhereNoTextComes) {
  send("\x81\xff\x02,\n");
  ASSERT_TRUE(trouble().has_value());
  EXPECT_THAT(trouble()->remedy, HasSubstr("imu_gateway.serial.baud"));
  send(std::string(600, '\x81'));  // not one end of line
  EXPECT_THAT(trouble()->remedy, HasSubstr("imu_gateway.serial.baud"));
}

TEST_F(LinkWatchTest, ShowsNoLineOfABoardThatWasUnplugged) {
  send("10,0.01,-0.02,1.00\n");
  parser_->reset();
  send(std::string(600, '\x81'));
  ASSERT_TRUE(trouble().has_value());
  EXPECT_THAT(trouble()->remedy, HasSubstr("imu_gateway.serial.baud"));
}

TEST_F(LinkWatchTest, NamesAMissingAccelerometer) {
  send("t_ms,mx_uT,my_uT,mz_uT\n1,20,0,-40\n");
  ASSERT_TRUE(trouble().has_value());
  EXPECT_THAT(trouble()->reason, HasSubstr("no acceleration"));
}

}  // namespace
}  // namespace vpdr::imu_gateway
