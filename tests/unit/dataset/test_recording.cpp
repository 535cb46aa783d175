#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "dataset/recording.hpp"
#include "tests/support/temporary_folder.hpp"

namespace vpdr::dataset {
namespace {

using ::testing::HasSubstr;

constexpr const char* kImuHeader =
    "#timestamp [ns],w_x [rad/s],w_y [rad/s],w_z [rad/s],a_x [m/s^2],a_y [m/s^2],a_z [m/s^2]\n";

class RecordingFolder : public ::testing::Test {
 protected:
  void write_imu(const std::string& rows) {
    folder_.write("imu0/data.csv", std::string(kImuHeader) + rows);
  }
  std::string fault() {
    try {
      read_recording(folder_.path());
    } catch (const FileFault& fault) {
      return fault.what();
    }
    return "no fault";
  }
  testing::TemporaryFolder folder_;
};

TEST_F(RecordingFolder, ReadsSamplesInTheSensorsAxes) {
  write_imu("10,1,2,3,4,5,6\n20,1,2,3,4,5,6\n");
  folder_.write("mag0/data.csv", "#timestamp [ns],m_x [uT],m_y [uT],m_z [uT]\n11,7,8,9\n");
  folder_.write("baro0/data.csv", "#timestamp [ns],pressure [Pa]\n12,101325\n");
  const Recording recording = read_recording(folder_.path());
  EXPECT_EQ(recording.name, folder_.path().filename().string());
  ASSERT_EQ(recording.imu.size(), 2U);
  EXPECT_EQ(recording.imu[1].stamp_ns, 20);
  EXPECT_EQ(recording.imu[0].angular_velocity_radps, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(recording.imu[0].specific_force_mps2, Eigen::Vector3d(4, 5, 6));
  EXPECT_TRUE(recording.imu[0].has_angular_velocity);
  ASSERT_EQ(recording.mag.size(), 1U);
  EXPECT_EQ(recording.mag[0].field_ut, Eigen::Vector3d(7, 8, 9));
  ASSERT_EQ(recording.pressure.size(), 1U);
  EXPECT_DOUBLE_EQ(recording.pressure[0].pressure_pa, 101325.0);
  EXPECT_EQ(recording.report.refused(), 0U);
}

TEST_F(RecordingFolder, AGyroscopeThatIsNanThroughoutIsAbsent) {
  write_imu("10,nan,nan,nan,4,5,6\n20,nan,nan,nan,4,5,6\n");
  const Recording recording = read_recording(folder_.path());
  ASSERT_EQ(recording.imu.size(), 2U);
  EXPECT_FALSE(recording.imu[0].has_angular_velocity);
  EXPECT_EQ(recording.imu[0].angular_velocity_radps, Eigen::Vector3d::Zero());
  EXPECT_EQ(recording.report.refused(), 0U);
}

TEST_F(RecordingFolder, AGyroscopeThatIsNanNowAndThenIsABadSample) {
  write_imu(
      "10,1,2,3,4,5,6\n20,nan,nan,nan,4,5,6\n30,nan,1,1,4,5,6\n40,1,2,3,4,inf,6\n50,0,0,0,1,1,1\n");
  const Recording recording = read_recording(folder_.path());
  ASSERT_EQ(recording.imu.size(), 2U);
  EXPECT_EQ(recording.imu[1].stamp_ns, 50);
  EXPECT_EQ(recording.report.files[0].refused(RowFault::kNonFinite), 3U);
  EXPECT_EQ(recording.report.files[0].accepted, 2U);
}

TEST_F(RecordingFolder, ApplyMountTurnsEverythingToTheBody) {
  write_imu("10,1,2,3,4,5,6\n");
  folder_.write("mag0/data.csv", "#timestamp [ns],m_x,m_y,m_z\n11,7,8,9\n");
  folder_.write("groundtruth.csv",
                "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w,q_x,q_y,q_z\n10,0,0,0,1,0,0,0\n");
  folder_.write("about.yaml", "carry: hand, flat\n");
  Recording recording = read_recording(folder_.path());
  EXPECT_EQ(recording.imu[0].specific_force_mps2, Eigen::Vector3d(4, 5, 6));
  for (int twice = 0; twice < 2; ++twice) {
    apply_mount(recording);
    EXPECT_EQ(recording.imu[0].specific_force_mps2, Eigen::Vector3d(5, -4, 6));
    EXPECT_EQ(recording.imu[0].angular_velocity_radps, Eigen::Vector3d(2, -1, 3));
    EXPECT_EQ(recording.mag[0].field_ut, Eigen::Vector3d(8, -7, 9));
    // The phone's axes lie along the world's, so its forward (+y) looks north.
    const Eigen::Vector3d forward =
        recording.truth.poses[0].world_from_sensor * Eigen::Vector3d::UnitX();
    EXPECT_TRUE(forward.isApprox(Eigen::Vector3d::UnitY()));
  }
}

TEST_F(RecordingFolder, EurocsLayoutWithImages) {
  folder_.write("mav0/imu0/data.csv", std::string(kImuHeader) + "10,1,2,3,4,5,6\n");
  folder_.write("mav0/cam0/data.csv", "#timestamp [ns],filename\n10,10.jpg\n20,20.jpg\n");
  folder_.write("mav0/cam0/data/10.jpg", "");
  folder_.write("gt/groundtruth_tum.txt", "1.5 1 2 3 0 0 0 1\n");
  const Recording recording = read_recording(folder_.path());
  ASSERT_EQ(recording.images.size(), 1U);
  EXPECT_EQ(recording.images[0].stamp_ns, 10);
  EXPECT_EQ(recording.report.files.at(1).refused(RowFault::kMissingFile), 1U);
  ASSERT_EQ(recording.truth.poses.size(), 1U);
  EXPECT_EQ(recording.truth.poses[0].stamp_ns, 1'500'000'000);
}

TEST_F(RecordingFolder, ImagesWithoutStampsGetANominalRateAndANote) {
  folder_.write("rgb/0000000082.png", "");
  folder_.write("rgb/0000000081.png", "");
  ReadOptions options;
  options.nominal_image_rate_hz = 10.0;
  const Recording recording = read_recording(folder_.path(), options);
  ASSERT_EQ(recording.images.size(), 2U);
  EXPECT_EQ(recording.images[0].file.filename(), "0000000081.png");
  EXPECT_EQ(recording.images[1].stamp_ns, 100'000'000);
  EXPECT_THAT(recording.report.lines().front(),
              HasSubstr("carry no stamps; assumed 10.0 images/s"));
}

TEST_F(RecordingFolder, ImageNamesMayBeStamps) {
  folder_.write("rgb/1311868164.363181.png", "");
  folder_.write("rgb/1311868164.399026.png", "");
  const Recording seconds = read_recording(folder_.path() / "rgb");
  ASSERT_EQ(seconds.images.size(), 2U);
  EXPECT_EQ(seconds.images[0].stamp_ns, 1311868164363181000);
  EXPECT_TRUE(seconds.report.notes.empty());
}

TEST_F(RecordingFolder, NamesWhatIsNoRecording) {
  EXPECT_THAT(fault(), HasSubstr("holds neither imu0/data.csv[.xz] nor images"));
  write_imu("");
  EXPECT_THAT(fault(), HasSubstr("imu0/data.csv: no usable inertial sample in 0 rows"));
  write_imu("10,1,2,3,nan,5,6\n");
  EXPECT_THAT(fault(), HasSubstr("no usable inertial sample in 1 rows"));
  folder_.write("imu0/data.csv", "#timestamp [ns],w_x [deg/s]\n");
  EXPECT_THAT(fault(), HasSubstr("imu0/data.csv:1:17: column 'w_x' has unit 'deg/s'"));
  EXPECT_THROW(read_recording(folder_.path() / "absent"), FileFault);
}

}  // namespace
}  // namespace vpdr::dataset
