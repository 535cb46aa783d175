// Recordings with holes: streams that pause, begin late or end early. The walk goes through to its
// end, as fast as it was told to, and nothing is lost.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>

#include "core/samples.hpp"
#include "integration/harness.hpp"
#include "sensor_msgs.h"

namespace vpdr::testing_support {
namespace {

using testing::HasSubstr;

constexpr int kImuHz = 100;
constexpr int kMagHz = 50;

/// A stream from `begin_s` to `end_s`; stamps after `hole_at_s` are later by `hole_s`.
struct Stream {
  double begin_s = 0.0;
  double end_s = 4.0;
  double hole_at_s = 0.0;
  double hole_s = 0.0;
};

std::size_t write_stream(const std::filesystem::path& file, const std::string& header,
                         const std::string& values, const Stream& stream, int rate_hz) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream out(file);
  out << header << "\n";
  const auto count = static_cast<int>((stream.end_s - stream.begin_s) * rate_hz);
  for (int i = 0; i < count; ++i) {
    double stamp_s = stream.begin_s + static_cast<double>(i) / rate_hz;
    if (stream.hole_s > 0.0 && stamp_s > stream.hole_at_s) stamp_s += stream.hole_s;
    out << to_ns(100.0 + stamp_s) << "," << values << "\n";
  }
  return static_cast<std::size_t>(count);
}

/// A board at rest: how many inertial and magnetic samples its recording holds.
std::pair<std::size_t, std::size_t> write_recording(const std::filesystem::path& folder,
                                                    const Stream& imu, const Stream& mag) {
  return {write_stream(folder / "imu0/data.csv",
                       "#timestamp [ns],w_x [rad/s],w_y [rad/s],w_z [rad/s],a_x [m/s^2],"
                       "a_y [m/s^2],a_z [m/s^2]",
                       "0,0,0,0,0,9.80665", imu, kImuHz),
          write_stream(folder / "mag0/data.csv", "#timestamp [ns],m_x [uT],m_y [uT],m_z [uT]",
                       "0,20,-40", mag, kMagHz)};
}

/// Plays the recording through imu_gateway, pdr and fusion as fast as nothing is lost. Of each
/// stream the gateway, pdr and fusion refuse `refused` samples, which jump too far ahead.
void expect_whole_walk(std::uint32_t domain_id, const Stream& imu, const Stream& mag,
                       std::size_t refused = 0) {
  TestDomain domain(domain_id);
  const auto folder = domain.folder() / "walk";
  const auto [imu_count, mag_count] = write_recording(folder, imu, mag);
  auto pdr = domain.start("pdr", {"--wait-for", "imu_gateway,fusion", "--until-end"});
  auto fusion = domain.start("fusion", {"--wait-for", "imu_gateway,pdr", "--until-end"});
  auto gateway = domain.start("imu_gateway", {"--recording", folder, "--rate", "0", "--until-end",
                                              "--wait-for", "pdr,fusion"});
  ASSERT_EQ(gateway.wait(kPatience), 0) << gateway.last_lines(5);
  EXPECT_EQ(pdr.wait(kPatience), 0) << pdr.last_lines(5);
  EXPECT_EQ(fusion.wait(kPatience), 0) << fusion.last_lines(5);
  ASSERT_TRUE(domain.wait_diagnostic("pdr", "state", "finished"));
  EXPECT_EQ(domain.diagnostic_of("pdr", "imu.received"), std::to_string(imu_count - refused));
  EXPECT_EQ(domain.diagnostic_of("pdr", "mag.received"), std::to_string(mag_count - refused));
  EXPECT_EQ(domain.diagnostic_of("fusion", "odometry.accepted"),
            std::to_string(imu_count - 2 * refused));
  EXPECT_THAT(gateway.last_lines(20), testing::Not(HasSubstr("stands still")));
}

TEST(PlaybackHoles, AHoleLongerThanTheWindowIsPassedOver) {
  expect_whole_walk(174, {.hole_at_s = 2.0, .hole_s = 0.6}, {.hole_at_s = 2.0, .hole_s = 0.6});
}

TEST(PlaybackHoles, AHoleOfAnHourIsPassedOver) {
  expect_whole_walk(175, {.hole_at_s = 2.0, .hole_s = 3600.0}, {.hole_at_s = 2.0, .hole_s = 3600.0},
                    1);
}

TEST(PlaybackHoles, TheMagnetometerMayOutlastTheInertialSamples) {
  expect_whole_walk(176, {.end_s = 2.5}, {.end_s = 60.0});
}

TEST(PlaybackHoles, TheInertialSamplesMayBeginLate) {
  expect_whole_walk(177, {.begin_s = 1.0}, {});
}

TEST(PlaybackHoles, PlayedAtARateAHoleIsAsLongAsRecordedAndSaidInTheLog) {
  TestDomain domain(178);
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  Collector mag(domain.participant(), dds::topics::kMag);
  const auto folder = domain.folder() / "walk";
  const Stream stream{.end_s = 1.0, .hole_at_s = 0.5, .hole_s = 9.0};
  const auto [imu_count, mag_count] = write_recording(folder, stream, stream);
  auto gateway = domain.start("imu_gateway", {"--recording", folder, "--rate", "3", "--until-end",
                                              "--wait-for", "observer"});
  domain.say_running();
  ASSERT_TRUE(imu.wait_count(1));
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(imu.wait_count(imu_count));
  EXPECT_GT(std::chrono::steady_clock::now() - begin, 2s) << "3 s of hole at this rate";
  EXPECT_EQ(gateway.wait(kPatience), 0);
  EXPECT_TRUE(mag.wait_count(mag_count));
  EXPECT_THAT(gateway.last_lines(5), HasSubstr("9.0 s without a sample"));
}

TEST(PlaybackHoles, AStandstillNamesWhoIsWaitedFor) {
  TestDomain domain(179);
  auto fusion = domain.start("fusion", {});
  auto gateway = domain.start("imu_gateway",
                              {"--simulate", "--rate", "0", "--until-end", "--wait-for", "fusion"});
  // Without pdr fusion never gets anywhere.
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "degraded"));
  EXPECT_THAT(domain.diagnostic_of("imu_gateway", "reason"),
              HasSubstr("fusion has not reported yet"));
  EXPECT_THAT(gateway.last_lines(5), HasSubstr("stands still"));
  for (auto* process : {&gateway, &fusion}) {
    process->signal(SIGTERM);
    EXPECT_EQ(process->wait(kPatience), 0);
  }
}

}  // namespace
}  // namespace vpdr::testing_support
