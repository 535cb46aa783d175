// What happens in the middle of a walk: a killed service, a full disk. The others go on, say so,
// and nothing already recorded is lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "core/errors.hpp"
#include "core/estimates.hpp"
#include "integration/harness.hpp"
#include "nav_msgs.h"
#include "sensor_msgs.h"
#include "vpdr_msgs.h"

namespace vpdr::testing_support {
namespace {

using testing::HasSubstr;

/// Whether the newest fused state is later than `stamp_s` and of this mode.
auto state_after(int stamp_s, FusionMode mode) {
  return [stamp_s, mode](const std::vector<vpdr_msgs::msg::FusionState>& states) {
    return !states.empty() && states.back().header().stamp().sec() >= stamp_s &&
           states.back().mode() == static_cast<std::uint8_t>(mode);
  };
}

TEST(RunningFaults, TheWalkGoesOnWhenVisionIsKilled) {
  TestDomain domain(150);
  Collector state(domain.participant(), dds::topics::kFusionState);
  auto pdr = domain.start("pdr", {"--wait-for", "imu_gateway,fusion,vision", "--until-end"});
  auto fusion = domain.start("fusion", {"--wait-for", "imu_gateway,pdr,vision", "--until-end"});
  auto vision = domain.start("vision", {"--wait-for", "imu_gateway,pdr,fusion", "--until-end",
                                        "--simulate", "--duration", "60"});
  auto gateway = domain.start("imu_gateway", {"--wait-for", "pdr,vision,fusion", "--until-end",
                                              "--simulate", "--duration", "60", "--rate", "0"});
  ASSERT_TRUE(state.wait(state_after(10, FusionMode::kWithVision)))
      << domain.describe("fusion") << domain.describe("vision") << gateway.last_lines(3);
  vision.signal(SIGKILL);
  EXPECT_EQ(gateway.wait(kPatience), 0) << gateway.last_lines(5);
  EXPECT_EQ(pdr.wait(kPatience), 0) << pdr.last_lines(5);
  EXPECT_EQ(fusion.wait(kPatience), 0) << fusion.last_lines(5);
  EXPECT_TRUE(state.wait(state_after(55, FusionMode::kInertial), 5s)) << domain.describe("fusion");
  EXPECT_THAT(gateway.last_lines(5), HasSubstr("vision has left"));
}

TEST(RunningFaults, TheWalkEndsWhenPdrIsKilled) {
  TestDomain domain(157);
  Collector odometry(domain.participant(), dds::topics::kFusedOdometry);
  const auto file = domain.folder() / "walk.mcap";
  auto pdr = domain.start("pdr", {"--wait-for", "imu_gateway,fusion,recorder", "--until-end"});
  auto fusion = domain.start("fusion", {"--wait-for", "imu_gateway,pdr,recorder", "--until-end"});
  auto recorder = domain.start(
      "recorder", {"--wait-for", "imu_gateway,pdr,fusion", "--until-end", "--out", file});
  auto gateway = domain.start("imu_gateway", {"--wait-for", "pdr,fusion,recorder", "--until-end",
                                              "--simulate", "--duration", "30", "--rate", "4"});
  ASSERT_TRUE(odometry.wait_count(200)) << domain.describe("fusion") << gateway.last_lines(3);
  pdr.signal(SIGKILL);
  EXPECT_EQ(pdr.wait(kPatience), 128 + SIGKILL);
  EXPECT_EQ(gateway.wait(kPatience), 0) << gateway.last_lines(5);
  EXPECT_EQ(fusion.wait(kPatience), 0) << fusion.last_lines(5);
  EXPECT_EQ(recorder.wait(kPatience), 0) << recorder.last_lines(5);
  EXPECT_THAT(gateway.last_lines(5), HasSubstr("pdr has left"));
  EXPECT_THAT(recorder.last_lines(5), HasSubstr("pdr left without finishing"));
}

TEST(RunningFaults, FusionSaysThatPdrWasKilledAndIsBack) {
  TestDomain domain(158);
  Collector odometry(domain.participant(), dds::topics::kFusedOdometry);
  auto fusion = domain.start("fusion", {});
  auto pdr = domain.start("pdr", {"--wait-for", "imu_gateway,fusion"});
  auto gateway = domain.start("imu_gateway", {"--wait-for", "pdr", "--simulate", "--rate", "1"});
  ASSERT_TRUE(odometry.wait_count(100)) << fusion.last_lines(3);
  pdr.signal(SIGKILL);
  EXPECT_EQ(pdr.wait(kPatience), 128 + SIGKILL);
  ASSERT_TRUE(domain.wait_diagnostic("fusion", "state", "degraded"));
  EXPECT_THAT(domain.diagnostic_of("fusion", "reason"), HasSubstr("pdr is silent"));
  auto again = domain.start("pdr", {});
  EXPECT_TRUE(domain.wait_diagnostic("fusion", "state", "running")) << domain.describe("fusion");
  for (auto* process : {&gateway, &again, &fusion}) {
    process->signal(SIGTERM);
    EXPECT_EQ(process->wait(kPatience), 0);
  }
  EXPECT_THAT(fusion.last_lines(20), HasSubstr("running again"));
}

TEST(RunningFaults, AKilledGatewayIsReportedAndComesBack) {
  TestDomain domain(151);
  Collector odometry(domain.participant(), dds::topics::kPdrOdometry);
  auto pdr = domain.start("pdr", {"--wait-for", "imu_gateway"});
  auto gateway = domain.start("imu_gateway", {"--wait-for", "pdr", "--simulate", "--rate", "1"});
  ASSERT_TRUE(odometry.wait_count(100)) << pdr.last_lines(3);
  gateway.signal(SIGKILL);
  EXPECT_EQ(gateway.wait(kPatience), 128 + SIGKILL);
  ASSERT_TRUE(domain.wait_diagnostic("pdr", "state", "degraded"));
  EXPECT_THAT(domain.diagnostic_of("pdr", "reason"), HasSubstr("imu_gateway is silent"));
  const std::size_t before = odometry.messages().size();
  // The new walk begins at stamp zero again: behind pdr's newest, so it is refused and counted...
  auto again = domain.start("imu_gateway", {"--wait-for", "pdr", "--simulate", "--rate", "0"});
  ASSERT_TRUE(domain.wait_diagnostic("pdr", "state", "running"));
  // ...until its stamps are past those that were seen.
  EXPECT_TRUE(odometry.wait_count(before + 100)) << domain.describe("pdr");
  EXPECT_NE(domain.diagnostic_of("pdr", "imu.refused.backward_in_time"), "");
  again.signal(SIGTERM);
  pdr.signal(SIGTERM);
  EXPECT_EQ(again.wait(kPatience), 0);
  EXPECT_EQ(pdr.wait(kPatience), 0);
}

TEST(RunningFaults, AKilledRecorderLosesAtMostTheLastChunk) {
  TestDomain domain(152);
  const auto file = domain.folder() / "torn.mcap";
  auto recorder = domain.start("recorder", {"--out", file});
  auto gateway =
      domain.start("imu_gateway", {"--wait-for", "recorder", "--simulate", "--rate", "1"});
  // Two of the recorder's reports after samples came: at least one chunk has been written.
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "running"));
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  ASSERT_TRUE(imu.wait_count(800)) << gateway.last_lines(3);
  recorder.signal(SIGKILL);
  EXPECT_EQ(recorder.wait(kPatience), 128 + SIGKILL);
  gateway.signal(SIGTERM);
  EXPECT_EQ(gateway.wait(kPatience), 0);
  tool::ChildProcess info("info", std::filesystem::path(VPDR_BIN_DIR) / "recorder",
                          {"info", file.string()}, domain.folder() / "info.log");
  EXPECT_EQ(info.wait(kPatience), 0) << info.last_lines(10);
  EXPECT_THAT(info.last_lines(20), HasSubstr("torn"));
  EXPECT_THAT(info.last_lines(20), HasSubstr("/walker/imu/data_raw"));
}

TEST(RunningFaults, AFullDiskKeepsWhatIsRecorded) {
  TestDomain domain(153);
  const auto file = domain.folder() / "full.mcap";
  const auto program = std::filesystem::path(VPDR_BIN_DIR) / "recorder";
  // A limit on the file's size stands for the full disk: writes beyond 64 KiB fail.
  const std::string command = "trap '' XFSZ; ulimit -f 64; exec " + program.string() + " --out " +
                              file.string() + " --interfaces 127.0.0.1 --domain 153";
  tool::ChildProcess recorder("recorder", "/bin/bash", {"-c", command},
                              domain.folder() / "full.log");
  auto gateway =
      domain.start("imu_gateway", {"--wait-for", "recorder", "--simulate", "--rate", "0"});
  EXPECT_EQ(recorder.wait(kPatience), static_cast<int>(ExitCode::kFile));
  EXPECT_THAT(recorder.last_lines(5), HasSubstr("full.mcap"));
  gateway.signal(SIGTERM);
  EXPECT_EQ(gateway.wait(kPatience), 0);
  tool::ChildProcess info("info", program, {"info", file.string()}, domain.folder() / "info.log");
  EXPECT_EQ(info.wait(kPatience), 0) << info.last_lines(10);
  EXPECT_THAT(info.last_lines(20), HasSubstr("/walker/imu/data_raw"));
}

}  // namespace
}  // namespace vpdr::testing_support
