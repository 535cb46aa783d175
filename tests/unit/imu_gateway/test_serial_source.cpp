#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/errors.hpp"
#include "imu_gateway/source/serial_source.hpp"

namespace vpdr::imu_gateway {
namespace {

/// A pseudo-terminal whose slave end is reached through a link, as a board's port by its udev name.
class Board {
 public:
  explicit Board(std::filesystem::path link) : link_(std::move(link)) { plug(); }
  ~Board() {
    unplug();
    std::filesystem::remove(link_);
  }
  void plug() {
    char name[128];
    ASSERT_EQ(openpty(&master_, &slave_, name, nullptr, nullptr), 0);
    std::filesystem::remove(link_);
    std::filesystem::create_symlink(name, link_);
  }
  void unplug() {
    if (master_ < 0) return;
    close(slave_);
    close(master_);
    master_ = slave_ = -1;
    std::filesystem::remove(link_);
  }
  void send(const std::string& text) {
    ASSERT_EQ(write(master_, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }

 private:
  std::filesystem::path link_;
  int master_ = -1;
  int slave_ = -1;
};

class SerialSourceTest : public testing::Test {
 protected:
  SerialOptions options() {
    SerialOptions o;
    o.device = link_;
    o.parser.lines.layouts = {LineLayout::parse("t_ms,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps").value(),
                              LineLayout::parse("t_ms,mx_uT,my_uT,mz_uT").value()};
    o.axes.accelerometer = -Eigen::Matrix3d::Identity();
    o.host_clock = [this] { return now_ns_; };
    return o;
  }
  /// Asks until a reading comes, at most a hundred times.
  static SampleSource::State wait_for_reading(SerialSource& source, Reading& out) {
    auto state = SampleSource::State::kIdle;
    for (int i = 0; i < 100 && state == SampleSource::State::kIdle; ++i) state = source.next(out);
    return state;
  }

  std::filesystem::path link_ =
      std::filesystem::temp_directory_path() / ("vpdr_board_" + std::to_string(getpid()));
  TimestampNs now_ns_ = 1'000 * kNsPerSecond;
};

TEST_F(SerialSourceTest, StampsAndTurnsWhatTheBoardSends) {
  Board board(link_);
  SerialSource source(options());
  board.send("1000,0,0,-1,0,0,90\n1000,1,2,3\n");
  Reading out;
  ASSERT_EQ(wait_for_reading(source, out), SampleSource::State::kReading);
  const auto& imu = std::get<ImuSample>(out);
  EXPECT_DOUBLE_EQ(imu.specific_force_mps2.z(), kGravityMps2);  // the board's sign is inverted
  EXPECT_EQ(imu.stamp_ns, now_ns_);
  ASSERT_EQ(wait_for_reading(source, out), SampleSource::State::kReading);
  EXPECT_DOUBLE_EQ(std::get<MagSample>(out).field_ut.z(), 3.0);
  // A line that comes 30 ms late keeps the board's own spacing.
  now_ns_ += 40'000'000;
  board.send("1010,0,0,-1,0,0,90\n");
  ASSERT_EQ(wait_for_reading(source, out), SampleSource::State::kReading);
  EXPECT_EQ(stamp_of(out), 1'000 * kNsPerSecond + 10'000'000);
}

TEST_F(SerialSourceTest, GoesOnWhenTheCableIsPulledAndPutBack) {
  Board board(link_);
  SerialSource source(options());
  Reading out;
  board.send("1000,0,0,-1,0,0,0\n");
  ASSERT_EQ(wait_for_reading(source, out), SampleSource::State::kReading);
  board.unplug();
  while (source.health().connected) ASSERT_EQ(source.next(out), SampleSource::State::kIdle);
  EXPECT_THAT(source.health().reason, testing::HasSubstr("vanished"));
  source.next(out);  // the port is gone: the next try waits
  EXPECT_FALSE(source.health().connected);
  board.plug();
  now_ns_ += kNsPerSecond;
  while (!source.health().connected) source.next(out);
  EXPECT_EQ(source.health().reconnections, 1U);
  board.send("5,0,0,-1,0,0,0\n");  // the board's clock started again
  ASSERT_EQ(wait_for_reading(source, out), SampleSource::State::kReading);
  EXPECT_EQ(stamp_of(out), now_ns_);
}

TEST_F(SerialSourceTest, CountsNoise) {
  Board board(link_);
  SerialSource source(options());
  Reading out;
  board.send("\xff\xfe,,\n1,2\n1000,0,0,-1,0,0,0\n");
  ASSERT_EQ(wait_for_reading(source, out), SampleSource::State::kReading);
  EXPECT_EQ(source.health().parser.malformed, 1U);
  EXPECT_EQ(source.health().parser.unknown_layout, 1U);
}

TEST_F(SerialSourceTest, TakesAnySpeed) {
  Board board(link_);
  for (const std::uint32_t baud : {9600U, 115200U, 74880U, 250000U, 1234567U, 3000000U}) {
    SerialOptions at_speed = options();
    at_speed.baud = baud;
    SerialSource source(at_speed);
    board.send("1000,0,0,-1,0,0,0\n");
    Reading out;
    EXPECT_EQ(wait_for_reading(source, out), SampleSource::State::kReading) << baud;
  }
}

TEST_F(SerialSourceTest, AFileIsNoPort) {
  std::ofstream(link_) << "1,2,3\n";
  EXPECT_THROW(SerialSource source(options()), DeviceFault);
  std::filesystem::remove(link_);
}

TEST_F(SerialSourceTest, MissingPortNamesTheRemedy) {
  try {
    SerialSource source(options());
    FAIL() << "opened a port that is not there";
  } catch (const DeviceFault& fault) {
    EXPECT_THAT(fault.what(), testing::HasSubstr("plugged in"));
    EXPECT_EQ(fault.code(), ExitCode::kDevice);
  }
}

}  // namespace
}  // namespace vpdr::imu_gateway
