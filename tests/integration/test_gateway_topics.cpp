// imu_gateway on the network: what a recording, the simulator and a board on a serial port become.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <fstream>
#include <thread>

#include "core/samples.hpp"
#include "dds/convert.hpp"
#include "integration/harness.hpp"
#include "sensor_msgs.h"
#include "support/pty_board.hpp"

namespace vpdr::testing_support {
namespace {

/// A recording of `count` samples at 100 Hz with one NaN row and one duplicate.
void write_recording(const std::filesystem::path& folder, int count) {
  std::filesystem::create_directories(folder / "imu0");
  std::filesystem::create_directories(folder / "mag0");
  std::ofstream imu(folder / "imu0/data.csv");
  std::ofstream mag(folder / "mag0/data.csv");
  imu << "#timestamp [ns],w_x [rad/s],w_y [rad/s],w_z [rad/s],a_x [m/s^2],a_y [m/s^2],a_z "
         "[m/s^2]\n";
  mag << "#timestamp [ns],m_x [uT],m_y [uT],m_z [uT]\n";
  for (int i = 0; i < count; ++i) {
    const long stamp = 1'000'000'000L + i * 10'000'000L;
    imu << stamp << "," << i * 1e-3 << ",0,0,0,0,9.80665\n";
    if (i == 5) imu << stamp << ",0,0,0,0,0,9.80665\n";
    if (i == 7) imu << stamp + 1 << ",nan,0,0,0,0,9.80665\n";
    if (i % 2 == 0) mag << stamp << ",0,20,-40\n";
  }
}

TEST(GatewayTopics, PlaysARecordingWithoutLoss) {
  TestDomain domain(120);
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  Collector mag(domain.participant(), dds::topics::kMag);
  const auto folder = domain.folder() / "walk";
  write_recording(folder, 2000);
  auto gateway = domain.start("imu_gateway", {"--recording", folder, "--rate", "0", "--until-end",
                                              "--wait-for", "observer"});
  domain.say_running();
  ASSERT_EQ(gateway.wait(kPatience), 0) << gateway.last_lines(5);
  ASSERT_TRUE(imu.wait_count(2000));
  ASSERT_TRUE(mag.wait_count(1000));
  const auto messages = imu.messages();
  EXPECT_EQ(messages.size(), 2000U);
  EXPECT_EQ(imu.lost() + mag.lost(), 0U);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    ImuSample sample;
    dds::from_msg(messages[i], sample);
    ASSERT_EQ(sample.stamp_ns, 1'000'000'000L + static_cast<long>(i) * 10'000'000L);
    ASSERT_DOUBLE_EQ(sample.angular_velocity_radps.x(), static_cast<double>(i) * 1e-3);
  }
  EXPECT_DOUBLE_EQ(mag.messages().front().magnetic_field().y(), 20e-6);
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "finished"));
  EXPECT_EQ(domain.diagnostic_of("imu_gateway", "recording.refused_rows"), "2");
}

TEST(GatewayTopics, SimulatesAWalk) {
  TestDomain domain(121);
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  Collector mag(domain.participant(), dds::topics::kMag);
  Collector pressure(domain.participant(), dds::topics::kPressure);
  auto gateway = domain.start("imu_gateway", {"--simulate", "--duration", "5", "--rate", "0",
                                              "--until-end", "--wait-for", "observer"});
  domain.say_running();
  ASSERT_EQ(gateway.wait(kPatience), 0) << gateway.last_lines(5);
  EXPECT_GE(imu.messages().size(), 990U);
  EXPECT_GE(pressure.messages().size(), 100U);
  EXPECT_EQ(imu.lost() + pressure.lost(), 0U);
}

TEST(GatewayTopics, ReadsABoardOnASerialPortAndSurvivesThePulledCable) {
  TestDomain domain(122);
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  Collector mag(domain.participant(), dds::topics::kMag);
  Collector pressure(domain.participant(), dds::topics::kPressure);
  int master = -1;
  int slave = -1;
  char name[128];
  const auto link = domain.folder() / "board";
  const auto plug = [&] {
    ASSERT_EQ(openpty(&master, &slave, name, nullptr, nullptr), 0);
    // The gateway must not inherit the board's end, or pulling the cable would not be noticed.
    fcntl(master, F_SETFD, FD_CLOEXEC);
    fcntl(slave, F_SETFD, FD_CLOEXEC);
    std::filesystem::remove(link);
    std::filesystem::create_symlink(name, link);
  };
  plug();
  auto gateway = domain.start("imu_gateway", {"--serial", link, "--wait-for", "observer"});
  domain.say_running();
  const auto send = [&](int from, int to) {
    for (int i = from; i < to; ++i) {
      const std::string t = std::to_string(i * 10);
      const std::string text = t + ",0,0,1,0,0,90\n" + t + ",1,2,3\n";
      ASSERT_EQ(write(master, text.data(), text.size()), static_cast<ssize_t>(text.size()));
    }
  };
  const std::string header = "t_ms,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps\nt_ms,mx_uT,my_uT,mz_uT\n";
  ASSERT_EQ(write(master, header.data(), header.size()), static_cast<ssize_t>(header.size()));
  send(0, 20);
  ASSERT_TRUE(imu.wait_count(20)) << domain.describe("imu_gateway");
  ASSERT_TRUE(mag.wait_count(20));
  EXPECT_NEAR(imu.messages().back().angular_velocity().z(), 1.5707963, 1e-6);
  EXPECT_NEAR(mag.messages().back().magnetic_field().z(), 3e-6, 1e-15);

  close(slave);
  close(master);
  std::filesystem::remove(link);
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "degraded"));
  plug();
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "serial.reconnections", "1"));
  send(0, 20);
  EXPECT_TRUE(imu.wait_count(40));
  gateway.signal(SIGTERM);
  EXPECT_EQ(gateway.wait(kPatience), 0);
  close(slave);
  close(master);
}

/// A driver of another make: its own participant, its own topic, best effort.
class Driver {
 public:
  Driver(std::uint32_t domain, bool reliable)
      : participant_([domain] {
          dds::ParticipantOptions options;
          options.domain = domain;
          options.walker = "driver";
          options.service = "driver";
          options.interfaces = {"127.0.0.1"};
          return options;
        }()),
        publisher_(participant_,
                   dds::Topic<sensor_msgs::msg::Imu>{
                       {"imu", "sensor_msgs/msg/Imu", "driver", dds::Qos{.reliable = reliable}}}) {}

  dds::Participant& participant() { return participant_; }
  [[nodiscard]] bool wait_for_reader() { return publisher_.wait_for_matched(1, kPatience); }
  void publish(int i) {
    ImuSample sample;
    sample.stamp_ns = kFirstNs + i * TimestampNs{10'000'000};
    sample.specific_force_mps2 = {1.0, 2.0, 9.8};
    sample.angular_velocity_radps = {0.001 * i, 0.0, 0.0};
    dds::to_msg(sample, message_);
    publisher_.publish(message_);
  }
  static constexpr TimestampNs kFirstNs = 1'000'000'000'000;

 private:
  dds::Participant participant_;
  dds::Publisher<sensor_msgs::msg::Imu> publisher_;
  sensor_msgs::msg::Imu message_;
};

TEST(GatewayTopics, ReadsARosDriversTopicAndKeepsItsStamps) {
  TestDomain domain(135);
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  auto gateway = domain.start("imu_gateway", {"--ros", "/driver/imu", "--wait-for", "observer",
                                              "--set", "mount.axes=+y,-x,+z"});
  domain.say_running();
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "degraded"));  // no driver yet
  {
    Driver driver(domain.domain(), false);
    ASSERT_TRUE(driver.wait_for_reader()) << domain.describe("imu_gateway");
    ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "running"));
    driver.publish(0);
    ASSERT_TRUE(imu.wait_count(1)) << domain.describe("imu_gateway");
    ImuSample sample;
    dds::from_msg(imu.messages().front(), sample);
    EXPECT_EQ(sample.stamp_ns, Driver::kFirstNs);
    EXPECT_EQ(sample.specific_force_mps2, Eigen::Vector3d(2.0, -1.0, 9.8));
  }
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "degraded"));
  // Another one takes its place.
  Driver driver(domain.domain(), true);
  ASSERT_TRUE(driver.wait_for_reader()) << domain.describe("imu_gateway");
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "running"));
  for (int i = 1; i < 20; ++i) {
    driver.publish(i);
    ASSERT_TRUE(imu.wait_count(static_cast<std::size_t>(i) + 1)) << i;
  }
  ImuSample last;
  dds::from_msg(imu.messages().back(), last);
  EXPECT_EQ(last.stamp_ns, Driver::kFirstNs + 19 * TimestampNs{10'000'000});
  gateway.signal(SIGTERM);
  EXPECT_EQ(gateway.wait(kPatience), 0);
}

// The inertial driver never pauses; that of the temperature comes all the same.
TEST(GatewayTopics, HearsARosDriverThatComesLate) {
  TestDomain domain(169);
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  Collector temperature(domain.participant(), dds::topics::kTemperature);
  auto gateway = domain.start(
      "imu_gateway",
      {"--ros", "/driver/imu", "--set", "ros.temperature=/driver/heat", "--wait-for", "observer"});
  domain.say_running();
  Driver driver(domain.domain(), true);
  ASSERT_TRUE(driver.wait_for_reader()) << domain.describe("imu_gateway");
  std::atomic<bool> over = false;
  std::thread walking([&] {
    for (int i = 0; !over; ++i) send_regularly(1, 10'000'000, [&](int) { driver.publish(i); });
  });
  EXPECT_TRUE(imu.wait_count(10));
  dds::Publisher<sensor_msgs::msg::Temperature> heat(
      driver.participant(), dds::Topic<sensor_msgs::msg::Temperature>{
                                {"heat", "sensor_msgs/msg/Temperature", "driver", dds::Qos{}}});
  EXPECT_TRUE(heat.wait_for_matched(1, kPatience)) << domain.describe("imu_gateway");
  sensor_msgs::msg::Temperature message;
  dds::to_msg(TimedValue{Driver::kFirstNs, 31.0}, message);
  heat.publish(message);
  EXPECT_TRUE(temperature.wait_count(1)) << domain.describe("imu_gateway");
  over = true;
  walking.join();
  EXPECT_EQ(temperature.messages().front().temperature(), 31.0);
  gateway.signal(SIGTERM);
  EXPECT_EQ(gateway.wait(kPatience), 0);
}

}  // namespace
}  // namespace vpdr::testing_support
