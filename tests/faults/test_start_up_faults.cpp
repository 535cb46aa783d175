// What users get wrong before anything runs: one clear message, the documented exit code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "core/errors.hpp"
#include "integration/harness.hpp"

namespace vpdr::testing_support {
namespace {

using testing::HasSubstr;

int code(ExitCode c) { return static_cast<int>(c); }

TEST(StartUpFaults, UnknownKeyNamesTheNearestOne) {
  TestDomain domain(140);
  for (const char* service : {"imu_gateway", "pdr", "vision", "fusion", "recorder"}) {
    auto process = domain.start(service, {"--set", "service.walkr=ada"});
    EXPECT_EQ(process.wait(kPatience), code(ExitCode::kConfiguration)) << service;
    EXPECT_THAT(process.last_lines(5),
                HasSubstr("did you mean " + std::string(service) + ".service.walker?"))
        << service;
  }
}

TEST(StartUpFaults, EveryMistakeOfAFileIsReportedAtOnce) {
  TestDomain domain(141);
  const auto file = domain.folder() / "pdr.yaml";
  std::ofstream(file) << "pdr:\n  step:\n    min_interval_s: -1\n    min_interval_s: 0.3\n"
                         "  attitude: {gap_s: .nan}\n";
  auto pdr = domain.start("pdr", {"--config", file});
  EXPECT_EQ(pdr.wait(kPatience), code(ExitCode::kConfiguration));
  const std::string log = pdr.last_lines(10);
  EXPECT_THAT(log, HasSubstr("pdr.yaml:3:21: pdr.step.min_interval_s: must be"));
  EXPECT_THAT(log, HasSubstr("pdr.yaml:4:5: pdr.step.min_interval_s: stands twice"));
  EXPECT_THAT(log, HasSubstr("pdr.yaml:5:21: pdr.attitude.gap_s: must be a finite number"));
}

TEST(StartUpFaults, UnknownOptionIsAUsageError) {
  TestDomain domain(142);
  auto fusion = domain.start("fusion", {"--no-such-option"});
  EXPECT_EQ(fusion.wait(kPatience), code(ExitCode::kUsage));
}

TEST(StartUpFaults, MissingRecordingIsNamed) {
  TestDomain domain(143);
  auto gateway = domain.start("imu_gateway", {"--recording", domain.folder() / "nowhere"});
  EXPECT_EQ(gateway.wait(kPatience), code(ExitCode::kFile));
  EXPECT_THAT(gateway.last_lines(3), HasSubstr("nowhere"));
}

TEST(StartUpFaults, UnknownColumnIsNamedWithItsPlace) {
  TestDomain domain(144);
  const auto folder = domain.folder() / "walk/imu0";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "data.csv") << "#timestamp [ns],w_x [rad/s],w_y [rad/s],banana\n0,0,0,0\n";
  auto gateway = domain.start("imu_gateway", {"--recording", domain.folder() / "walk"});
  EXPECT_EQ(gateway.wait(kPatience), code(ExitCode::kFile));
  EXPECT_THAT(gateway.last_lines(3), HasSubstr("data.csv:1:"));
  EXPECT_THAT(gateway.last_lines(3), HasSubstr("banana"));
}

TEST(StartUpFaults, NoSourceOrTwoSourcesAreRefused) {
  TestDomain domain(145);
  auto none = domain.start("imu_gateway", {});
  EXPECT_EQ(none.wait(kPatience), code(ExitCode::kConfiguration));
  EXPECT_THAT(none.last_lines(3), HasSubstr("--recording DIR"));
  auto two = domain.start("imu_gateway", {"--simulate", "--serial", "/dev/null"});
  EXPECT_EQ(two.wait(kPatience), code(ExitCode::kConfiguration));
}

TEST(StartUpFaults, MissingPortNamesTheRemedy) {
  TestDomain domain(146);
  auto gateway = domain.start("imu_gateway", {"--serial", "/dev/vpdr_no_such_port"});
  EXPECT_EQ(gateway.wait(kPatience), code(ExitCode::kDevice));
  EXPECT_THAT(gateway.last_lines(3), HasSubstr("/dev/vpdr_no_such_port"));
  EXPECT_THAT(gateway.last_lines(3), HasSubstr("plugged in"));
}

TEST(StartUpFaults, SecondInstanceForTheSameWalkerLeaves) {
  TestDomain domain(147);
  auto first = domain.start("pdr", {});
  ASSERT_TRUE(domain.wait_diagnostic("pdr", "state", "running"));
  auto second = domain.start("pdr", {});
  EXPECT_EQ(second.wait(kPatience), code(ExitCode::kDds));
  EXPECT_THAT(second.last_lines(3), HasSubstr("runs already for walker walker"));
  auto other_walker = domain.start("pdr", {"--walker", "ada", "--until-end"});
  EXPECT_EQ(other_walker.wait(3s), std::nullopt) << other_walker.last_lines(3);
  other_walker.signal(SIGTERM);
  EXPECT_EQ(other_walker.wait(kPatience), 0);
  EXPECT_EQ(first.exit_code(), std::nullopt) << "the first instance must stay";
  first.signal(SIGINT);
  EXPECT_EQ(first.wait(kPatience), 0);
}

TEST(StartUpFaults, RecorderRefusesToOverwrite) {
  TestDomain domain(148);
  const auto file = domain.folder() / "kept.mcap";
  std::ofstream(file) << "precious";
  auto recorder = domain.start("recorder", {"--out", file});
  EXPECT_EQ(recorder.wait(kPatience), code(ExitCode::kFile));
  EXPECT_THAT(recorder.last_lines(3), HasSubstr("kept.mcap"));
  std::string content;
  std::ifstream(file) >> content;
  EXPECT_EQ(content, "precious");
}

}  // namespace
}  // namespace vpdr::testing_support
