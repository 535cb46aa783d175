#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "core/samples.hpp"
#include "dataset/board_log.hpp"
#include "tests/support/recordings.hpp"
#include "tests/support/temporary_folder.hpp"

namespace vpdr::dataset {
namespace {

TEST(BoardLog, ReadsColumnsUnitsAndTemperature) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("log.csv",
                                 "t_ms,ax_g,ay_g,az_g,gx_dps,gy_dps,gz_dps,temp_C,skip1\n"
                                 "10,0,0,1,180,0,0,24.5,x\n"
                                 "20,0,0,-1,0,90,0,24.6,y\n");
  const BoardLog log = read_board_log(file);
  ASSERT_EQ(log.streams.force_mps2.size(), 2U);
  EXPECT_EQ(log.streams.force_mps2[1].stamp_ns, 20'000'000);
  EXPECT_DOUBLE_EQ(log.streams.force_mps2[1].value.z(), -kGravityMps2);
  EXPECT_DOUBLE_EQ(log.streams.rate_radps[0].value.x(), kPi);
  EXPECT_DOUBLE_EQ(log.streams.temperature_c[1].value, 24.6);
  EXPECT_TRUE(log.streams.field_ut.empty());
}

TEST(BoardLog, ReadsWordedHeadersAndLogsWithoutOne) {
  const testing::TemporaryFolder folder;
  const auto worded = folder.write("xio.csv",
                                   "Time (s),Gyroscope X (deg/s),Gyroscope Y (deg/s),Gyroscope Z "
                                   "(deg/s),Magnetometer X (uT),Magnetometer Y (uT),Magnetometer Z "
                                   "(uT)\n0.5,0,0,180,1,2,3\n");
  const BoardLog xio = read_board_log(worded);
  EXPECT_DOUBLE_EQ(xio.streams.rate_radps.at(0).value.z(), kPi);
  EXPECT_DOUBLE_EQ(xio.streams.field_ut.at(0).value.y(), 2.0);
  const auto bare = folder.write("gyroscope.txt", "0.153842087 -0.5 1.5E-4 8.8 9 9\n");
  const BoardLog phone = read_board_log(bare);
  EXPECT_EQ(phone.streams.rate_radps.at(0).stamp_ns, 153'842'087);
  EXPECT_DOUBLE_EQ(phone.streams.rate_radps.at(0).value.y(), 1.5e-4);
}

TEST(BoardLog, RefusesBadRowsAndCountsThem) {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("log.csv",
                                 "t_s,mx_G,my_G,mz_G\n"
                                 "1,0.1,0.2,0.3\n"
                                 "1,0.1,0.2,0.3\n"    // the same stamp
                                 "0.5,0.1,0.2,0.3\n"  // back in time
                                 "2,0.1,nan,0.3\n"    // no finite number
                                 "3,0.1,0.2\n"        // torn
                                 "4,0.1,0.2,0.3\n");
  const BoardLog log = read_board_log(file);
  EXPECT_EQ(log.streams.field_ut.size(), 2U);
  EXPECT_EQ(log.refused_rows, 4U);
  EXPECT_DOUBLE_EQ(log.streams.field_ut[1].value.x(), 10.0);
}

TEST(BoardLog, NamesTheMistake) {
  const testing::TemporaryFolder folder;
  const auto says = [](const std::filesystem::path& file) -> std::string {
    try {
      read_board_log(file);
    } catch (const FileFault& fault) {
      return fault.what();
    }
    return "";
  };
  EXPECT_NE(says(folder.write("a.csv", "t_s,wind_mps\n1,2\n")).find("wind_mps"), std::string::npos);
  EXPECT_NE(says(folder.write("b.csv", "ax_g,ay_g,az_g\n1,2,3\n")).find("time"), std::string::npos);
  EXPECT_NE(says(folder.write("c.csv", "1,2,3\n")).find("header"), std::string::npos);
  EXPECT_NE(says(folder.write("d.csv", "t_s,ax_g\nx,y\n")).find("no row"), std::string::npos);
  EXPECT_NE(says(folder.path() / "absent.csv").find("absent.csv"), std::string::npos);
}

TEST(BoardLog, PutsSessionsOneAfterTheOther) {
  const testing::TemporaryFolder folder;
  const auto a = folder.write("a.csv", "t_s,ax_g,ay_g,az_g\n1,0,0,1\n2,0,0,1\n");
  const auto a_mag = folder.write("a_mag.csv", "t_s,mx_uT,my_uT,mz_uT\n1.5,1,2,3\n");
  const auto b = folder.write("b.csv", "t_s,ax_g,ay_g,az_g\n1,0,0,1\n");
  const BoardLog log = read_board_logs({a, a_mag, b});
  ASSERT_EQ(log.streams.force_mps2.size(), 3U);
  EXPECT_EQ(log.streams.field_ut[0].stamp_ns, 1'500'000'000) << "one session, one clock";
  EXPECT_GT(log.streams.force_mps2[2].stamp_ns, 10 * kNsPerSecond);
}

TEST(BoardLog, ReadsTheLogsOfRealBoards) {
  VPDR_REQUIRE_RECORDINGS(root);
  const BoardLog xio = read_board_log(root / "boards/xio_fusion/sensor_data.csv");
  EXPECT_EQ(xio.streams.force_mps2.size(), 13514U);
  EXPECT_EQ(xio.refused_rows, 0U);
  EXPECT_NEAR(xio.streams.force_mps2.front().value.norm(), kGravityMps2, 0.1);
}

}  // namespace
}  // namespace vpdr::dataset
