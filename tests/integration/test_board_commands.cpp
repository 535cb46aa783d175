// A board on the desk: its calibration in the gateway, vpdr calibrate and vpdr monitor beside it.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "calibration_file/calibration_file.hpp"
#include "core/samples.hpp"
#include "dds/convert.hpp"
#include "integration/harness.hpp"
#include "sensor_msgs.h"
#include "support/pty_board.hpp"
#include "unit/calibration/synthetic_board.hpp"
#include "vpdr_msgs.h"

namespace vpdr::testing_support {
namespace {

namespace fs = std::filesystem;

/// A recording folder of these streams (one stamp for force and rate).
void write_recording(const fs::path& folder, const SensorStreams& streams) {
  fs::create_directories(folder / "imu0");
  fs::create_directories(folder / "mag0");
  std::ofstream imu(folder / "imu0/data.csv");
  std::ofstream mag(folder / "mag0/data.csv");
  imu << "#timestamp [ns],w_x [rad/s],w_y [rad/s],w_z [rad/s],a_x [m/s^2],a_y [m/s^2],a_z "
         "[m/s^2]\n";
  mag << "#timestamp [ns],m_x [uT],m_y [uT],m_z [uT]\n";
  for (std::size_t i = 0; i < streams.force_mps2.size(); ++i) {
    const auto& w = streams.rate_radps[i].value;
    const auto& a = streams.force_mps2[i].value;
    const auto& m = streams.field_ut[i].value;
    const TimestampNs stamp = streams.force_mps2[i].stamp_ns + kNsPerSecond;
    imu << stamp << "," << w.x() << "," << w.y() << "," << w.z() << "," << a.x() << "," << a.y()
        << "," << a.z() << "\n";
    mag << stamp << "," << m.x() << "," << m.y() << "," << m.z() << "\n";
  }
}

SensorStreams at_rest(double seconds) {
  using namespace calibration::testing;
  return true_streams(attitudes({Eigen::Quaterniond::Identity()}, seconds, 0.0));
}

tool::ChildProcess run_vpdr(const TestDomain& domain, std::vector<std::string> arguments,
                            const fs::path& log) {
  setenv("VPDR_INTERFACES", "127.0.0.1", 1);
  arguments.insert(arguments.end(), {"--domain", std::to_string(domain.domain())});
  return tool::ChildProcess("vpdr", fs::path(VPDR_BIN_DIR) / "vpdr", arguments, log);
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(GatewayCalibration, IsAppliedAndPublished) {
  TestDomain domain(160);
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  Collector mag(domain.participant(), dds::topics::kMag);
  Collector calibrations(domain.participant(), dds::topics::kCalibration);
  write_recording(domain.folder() / "walk", at_rest(5.0));
  calibration::BoardCalibration board;
  board.board = "MPU6050";
  board.accelerometer.correction.bias = {0.0, 0.0, -0.25};
  board.gyroscope.correction.bias = {0.5, 0.0, 0.0};
  board.magnetometer.field_ut = 48.0;
  const fs::path file = domain.folder() / "board.yaml";
  calibration::write_calibration(board, file);
  auto gateway =
      domain.start("imu_gateway", {"--recording", domain.folder() / "walk", "--calibration", file,
                                   "--rate", "0", "--until-end", "--wait-for", "observer"});
  domain.say_running();
  ASSERT_EQ(gateway.wait(kPatience), 0) << gateway.last_lines(5);
  ASSERT_TRUE(imu.wait_count(500));
  ImuSample sample;
  dds::from_msg(imu.messages().back(), sample);
  EXPECT_NEAR(sample.specific_force_mps2.z(), kGravityMps2 + 0.25, 0.1);
  EXPECT_NEAR(sample.angular_velocity_radps.x(), -0.5, 0.01);
  ASSERT_TRUE(calibrations.wait_count(1));
  EXPECT_EQ(calibrations.messages().back().board(), "MPU6050");
  EXPECT_NEAR(calibrations.messages().back().field_strength(), 48e-6, 1e-12);
}

TEST(GatewayCalibration, AWrongFileIsAConfigurationFault) {
  TestDomain domain(161);
  const fs::path file = domain.folder() / "board.yaml";
  std::ofstream(file) << "calibration:\n  gyroscope:\n    axes: \"+x,+x,+z\"\n";
  auto gateway = domain.start("imu_gateway", {"--simulate", "--calibration", file});
  EXPECT_EQ(gateway.wait(kPatience), 3);
  EXPECT_NE(gateway.last_lines(5).find("calibration.gyroscope.axes"), std::string::npos)
      << gateway.last_lines(5);
}

TEST(GatewayChecks, NameTheUnitOfAnAccelerometerInG) {
  TestDomain domain(162);
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  Collector mag(domain.participant(), dds::topics::kMag);
  SensorStreams streams = at_rest(8.0);
  for (TimedVector& f : streams.force_mps2) f.value /= kGravityMps2;
  write_recording(domain.folder() / "walk", streams);
  auto gateway = domain.start("imu_gateway", {"--recording", domain.folder() / "walk", "--rate",
                                              "0", "--until-end", "--wait-for", "observer"});
  domain.say_running();
  ASSERT_EQ(gateway.wait(kPatience), 0) << gateway.last_lines(5);
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "finished"));
  EXPECT_NE(domain.diagnostic_of("imu_gateway", "check.gravity").find("1.00 m/s^2"),
            std::string::npos)
      << domain.describe("imu_gateway");
  EXPECT_NE(gateway.last_lines(20).find("read in g"), std::string::npos) << "not logged";
}

TEST(MonitorImu, ShowsRateLossAndLengths) {
  TestDomain domain(163);
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  auto gateway = domain.start("imu_gateway", {"--simulate", "--duration", "600", "--rate", "1"});
  ASSERT_TRUE(imu.wait_count(1)) << gateway.last_lines(5);
  const fs::path log = domain.folder() / "monitor.log";
  auto monitor = run_vpdr(domain, {"monitor", "imu", "--once", "--json"}, log);
  ASSERT_EQ(monitor.wait(kPatience), 0) << monitor.last_lines(5);
  const auto view = nlohmann::json::parse(monitor.last_lines(1));
  EXPECT_NEAR(view["imu"]["rate_hz"].get<double>(), 200.0, 1.0);
  EXPECT_LT(view["imu"]["stamp_jitter_ms"].get<double>(), 0.1);
  EXPECT_EQ(view["imu"]["lost"].get<int>(), 0);
  EXPECT_NEAR(view["imu"]["mean"].get<double>(), kGravityMps2, 1.5);
  EXPECT_NEAR(view["mag"]["mean"].get<double>(), 48.0, 20.0);
  auto text = run_vpdr(domain, {"monitor", "imu", "--once"}, domain.folder() / "text.log");
  ASSERT_EQ(text.wait(kPatience), 0);
  EXPECT_NE(text_of(domain.folder() / "text.log").find("m/s^2"), std::string::npos);
  gateway.signal(SIGTERM);
  EXPECT_EQ(gateway.wait(kPatience), 0);
}

TEST(BoardNobodyUnderstands, IsShownWithWhatItSends) {
  TestDomain domain(166);
  PtyBoard port(domain.folder() / "board");
  auto up = run_vpdr(domain,
                     {"up", "--serial", domain.folder() / "board", "--out", domain.folder() / "up"},
                     domain.folder() / "up.log");
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "running"));
  std::atomic<bool> seen = false;
  std::thread board_thread([&] {
    while (!seen) send_regularly(1, 10'000'000, [&](int) { port.send("10,0.01,-0.02,1.00\n"); });
  });
  EXPECT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "degraded"));
  auto monitor = run_vpdr(domain, {"monitor", "imu", "--once"}, domain.folder() / "monitor.log");
  EXPECT_EQ(monitor.wait(kPatience), 0) << monitor.last_lines(5);
  seen = true;
  board_thread.join();
  up.signal(SIGINT);
  EXPECT_EQ(up.wait(kPatience), 6) << "no pose was recorded";
  for (const char* file : {"monitor.log", "up.log", "up/logs/imu_gateway.log"}) {
    const std::string text = text_of(domain.folder() / file);
    EXPECT_NE(text.find("`10,0.01,-0.02,1.00`"), std::string::npos) << file << ": " << text;
    EXPECT_NE(text.find("imu_gateway.serial.lines"), std::string::npos) << file << ": " << text;
  }
}

TEST(Temperature, IsPublishedUsedAndShown) {
  TestDomain domain(167);
  Collector imu(domain.participant(), dds::topics::kImuRaw);
  Collector mag(domain.participant(), dds::topics::kMag);
  Collector pressure(domain.participant(), dds::topics::kPressure);
  Collector temperature(domain.participant(), dds::topics::kTemperature);
  calibration::BoardCalibration board;
  board.gyroscope.bias_slope = {0.0, 0.0, 0.01};
  board.gyroscope.temperature_c = 25.0;
  board.gyroscope.temperature_span_c = 20.0;
  const fs::path file = domain.folder() / "board.yaml";
  calibration::write_calibration(board, file);
  PtyBoard port(domain.folder() / "board");
  auto gateway = domain.start(
      "imu_gateway",
      {"--serial", domain.folder() / "board", "--calibration", file, "--wait-for", "observer",
       "--set", "serial.lines=[\"t_ms,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps,temp_C\"]"});
  domain.say_running();
  ASSERT_TRUE(domain.wait_diagnostic("imu_gateway", "state", "running"));
  ASSERT_TRUE(temperature.subscription().wait_for_matched(1, kPatience));
  auto monitor = run_vpdr(domain, {"monitor", "imu", "--once", "--json"}, domain.folder() / "log");
  // 31 C; one reading that no board has.
  std::atomic<bool> watched = false;
  std::thread board_thread([&] {
    for (int i = 0; !watched; ++i) {
      send_regularly(1, 10'000'000, [&](int) {
        port.send(std::to_string(10 * i) + ",0,0,1,0,0,0," + (i == 50 ? "900" : "31") + "\n");
      });
    }
  });
  const auto code = monitor.wait(kPatience);
  EXPECT_TRUE(temperature.wait_count(20));
  EXPECT_TRUE(imu.wait_count(200));
  EXPECT_TRUE(domain.wait_diagnostic("imu_gateway", "serial.odd_temperatures", "1"));
  watched = true;
  board_thread.join();
  EXPECT_EQ(code, 0) << monitor.last_lines(5);
  EXPECT_EQ(nlohmann::json::parse(monitor.last_lines(1))["temperature_c"].get<double>(), 31.0);
  for (const auto& message : temperature.messages()) EXPECT_EQ(message.temperature(), 31.0);
  EXPECT_LT(temperature.messages().size(), imu.messages().size() / 5);
  // Six degrees above the calibration's: the bias is 0.06 rad/s higher, and taken off.
  EXPECT_NEAR(imu.messages().back().angular_velocity().z(), -0.06, 1e-9);
  gateway.signal(SIGTERM);
  EXPECT_EQ(gateway.wait(kPatience), 0);
}

TEST(CalibrateMag, OfALiveBoardUndoesWhatTheGatewayApplies) {
  using namespace calibration::testing;
  TestDomain domain(164);
  SensorStreams streams = true_streams(attitudes(all_ways(), 0.0, 1.0));
  for (TimedVector& m : streams.field_ut) m.value += Eigen::Vector3d(20.0, -30.0, 40.0);
  write_recording(domain.folder() / "sphere", streams);
  calibration::BoardCalibration old;
  old.board = "MPU6050";
  old.magnetometer.date = "2024-01-01T00:00:00Z";
  old.magnetometer.correction.bias = {-5.0, 60.0, 3.0};
  old.mount.date = old.magnetometer.date;
  old.mount.body_from_board = pose({0, 1, 0}).toRotationMatrix();
  const fs::path file = domain.folder() / "board.yaml";
  calibration::write_calibration(old, file);
  auto calibrate =
      run_vpdr(domain, {"calibrate", "mag", "--out", file}, domain.folder() / "calibrate.log");
  ASSERT_TRUE(domain.participant().wait_for_service("vpdr_calibrate", kPatience));
  auto gateway = domain.start("imu_gateway", {"--recording", domain.folder() / "sphere",
                                              "--calibration", file, "--rate", "10"});
  ASSERT_EQ(calibrate.wait(2 * kPatience), 0) << calibrate.last_lines(5);
  const calibration::BoardCalibration found = calibration::read_calibration(file);
  EXPECT_LT((found.magnetometer.correction.bias - Eigen::Vector3d(20, -30, 40)).norm(), 1.0);
  EXPECT_GT(found.magnetometer.coverage, 0.8);
  EXPECT_EQ(found.board, "MPU6050") << "what was known stays";
  EXPECT_EQ(found.mount.date, old.mount.date);
  gateway.signal(SIGTERM);
  gateway.wait(kPatience);
}

TEST(CalibrateImu, RefusesTwoPosesAndLeavesTheFileAlone) {
  using namespace calibration::testing;
  TestDomain domain(165);
  write_recording(domain.folder() / "two",
                  true_streams(attitudes({pose({0, 0, 1}), pose({1, 0, 0})}, 3.0, 1.0)));
  const fs::path file = domain.folder() / "board.yaml";
  auto calibrate = run_vpdr(domain, {"calibrate", "imu", domain.folder() / "two", "--out", file},
                            domain.folder() / "calibrate.log");
  EXPECT_EQ(calibrate.wait(kPatience), 6);
  EXPECT_NE(calibrate.last_lines(5).find("six sides"), std::string::npos)
      << calibrate.last_lines(5);
  EXPECT_FALSE(fs::exists(file));
}

}  // namespace
}  // namespace vpdr::testing_support
