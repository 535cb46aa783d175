// Each kind of board at 1 kHz through the real imu_gateway: every sample arrives, in order and as
// it was measured. How fast is told by bench/board_latency.cpp.
#include <algorithm>
#include <csignal>

#include "core/samples.hpp"
#include "dds/convert.hpp"
#include "integration/harness.hpp"
#include "sensor_msgs.h"
#include "support/boards.hpp"
#include "support/pty_board.hpp"

namespace vpdr::testing_support {
namespace {

constexpr int kCount = 4000;
constexpr std::int64_t kPeriodNs = 1'000'000;

/// The angular rate tells which measurement it is: one count of a WT901 for each.
constexpr double kRateStep_dps = 2000.0 / 32768.0;

Measurement measurement(int i) {
  Measurement m;
  m.time_us = 5'000'000 + static_cast<std::uint64_t>(i) * 1000;
  m.acceleration_g = {0.01 * (i % 7), 0.02 * (i % 5), 1.0};
  m.rate_dps = {kRateStep_dps * i, 0.1 * (i % 3), 0.0};
  m.field_ut = {20.0, 0.1 * (i % 50), -40.0};
  return m;
}

struct BoardKind {
  std::string name;
  std::uint32_t domain;
  std::vector<std::string> settings;
  std::function<std::string(int)> bytes;
};

class BoardProtocols : public testing::TestWithParam<BoardKind> {};

TEST_P(BoardProtocols, NothingIsLostAtOneKilohertz) {
  const BoardKind& kind = GetParam();
  TestDomain domain(kind.domain);
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  Collector mag(domain.participant(), dds::topics::kMag);
  Collector pressure(domain.participant(), dds::topics::kPressure);
  PtyBoard board(domain.folder() / "board");
  std::vector<std::string> arguments{"--serial", domain.folder() / "board", "--wait-for",
                                     "observer"};
  for (const std::string& setting : kind.settings) {
    arguments.insert(arguments.end(), {"--set", setting});
  }
  auto gateway = domain.start("imu_gateway", arguments);
  domain.say_running();
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "running"));
  send_regularly(kCount, kPeriodNs, [&](int i) { board.send(kind.bytes(i)); });

  ASSERT_TRUE(imu.wait_count(kCount)) << domain.describe("imu_gateway");
  ASSERT_TRUE(mag.wait_count(kCount)) << domain.describe("imu_gateway");
  EXPECT_EQ(imu.lost() + mag.lost(), 0U);
  const auto messages = imu.messages();
  ASSERT_EQ(messages.size(), static_cast<std::size_t>(kCount));
  TimestampNs last_ns = 0;
  for (int i = 0; i < kCount; ++i) {
    ImuSample sample;
    dds::from_msg(messages[static_cast<std::size_t>(i)], sample);
    const double rate_dps = sample.angular_velocity_radps.x() * 180.0 / M_PI;
    ASSERT_NEAR(rate_dps, kRateStep_dps * i, 0.1 * kRateStep_dps) << i;
    ASSERT_NEAR(sample.specific_force_mps2.x(), 9.80665 * 0.01 * (i % 7), 3e-3) << i;
    ASSERT_GT(sample.stamp_ns, last_ns) << i;
    last_ns = sample.stamp_ns;
  }
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "imu.published", std::to_string(kCount)));
  for (const char* counter : {"serial.malformed", "serial.unknown_layout", "serial.lost",
                              "serial.incomplete", "serial.clock_resets"}) {
    EXPECT_EQ(domain.diagnostic_of("imu_gateway", counter), "0") << counter;
  }
  gateway.signal(SIGTERM);
  EXPECT_EQ(gateway.wait(kPatience), 0);
}

INSTANTIATE_TEST_SUITE_P(
    All, BoardProtocols,
    testing::Values(
        BoardKind{"text",
                  130,
                  {std::string("serial.lines=[\"") + kTextColumns + "\"]"},
                  [](int i) { return text_bytes(measurement(i)); }},
        BoardKind{
            "xio", 131, {"serial.protocol=xio"}, [](int i) { return xio_bytes(measurement(i)); }},
        BoardKind{
            "wit", 132, {"serial.protocol=wit"}, [](int i) { return wit_bytes(measurement(i)); }},
        BoardKind{"vpdr",
                  133,
                  {"serial.protocol=vpdr"},
                  [](int i) { return vpdr_bytes(measurement(i), static_cast<std::uint16_t>(i)); }}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace vpdr::testing_support
