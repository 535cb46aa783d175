#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "core/errors.hpp"
#include "evaluation/run_directory.hpp"
#include "evaluation/run_writer.hpp"
#include "tests/support/temporary_folder.hpp"

namespace vpdr::evaluation {
namespace {

using ::testing::HasSubstr;

constexpr TimestampNs kStart =
    1574657205484000001;  // a double of seconds would lose the last digits

PoseEstimate pose_at(TimestampNs stamp, double x, double y) {
  PoseEstimate pose;
  pose.stamp_ns = stamp;
  pose.position_m = {x, y, 0.5};
  pose.covariance(0, 0) = 0.04;
  pose.covariance(1, 1) = 0.09;
  pose.covariance(0, 1) = pose.covariance(1, 0) = -0.01;
  pose.covariance(5, 5) = 0.0025;
  return pose;
}

void write_small_run(const std::filesystem::path& folder, bool vision) {
  RunWriter writer(folder, {.vision_heading = vision});
  for (int i = 0; i < 3; ++i) {
    const TimestampNs stamp = kStart + i * 10'000'000;
    AttitudeEstimate attitude;
    attitude.stamp_ns = stamp;
    attitude.world_from_body = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
    writer.add_attitude(attitude);
    writer.add_pdr(pose_at(stamp, i, 0.0));
    writer.add_fused(pose_at(stamp, i, 0.25));
  }
  StepEvent step;
  step.stamp_ns = kStart + 5;
  step.length_m = 0.75;
  step.yaw_rad = -1.25;
  writer.add_step(step);
  step.stamp_ns = kStart + 6;
  step.status = StepStatus::kTentative;
  writer.add_step(step);  // is none yet
  CorridorHeading heading;
  heading.stamp_ns = kStart + 7;
  writer.add_vision_heading(heading);  // found no corridor
  heading.stamp_ns = kStart + 8;
  heading.found = true;
  heading.heading_rad = 0.5;
  heading.sigma_rad = 0.01;
  writer.add_vision_heading(heading);
  writer.finish({.duration_s = 0.02, .speed_factor = 300.0});
}

std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::string fault_of_reading(const std::filesystem::path& folder) {
  try {
    RunDirectory::read(folder);
  } catch (const FileFault& fault) {
    return fault.what();
  }
  return "no fault";
}

TEST(RunWriter, WritesTheColumnsThatOthersRead) {
  const testing::TemporaryFolder folder;
  write_small_run(folder.path(), true);
  EXPECT_THAT(text_of(folder.path() / "trajectory.tum"),
              HasSubstr("1574657205.494000001 1.000000000 0.250000000 0.500000000 0.000000000 "
                        "0.000000000 0.000000000 1.000000000\n"));
  EXPECT_THAT(text_of(folder.path() / "attitude.csv"),
              ::testing::StartsWith("#timestamp [ns],q_w,q_x,q_y,q_z\n1574657205484000001,"
                                    "0.500000000,0.500000000,-0.500000000,0.500000000\n"));
  EXPECT_EQ(text_of(folder.path() / "steps.csv"),
            "#timestamp [ns],length [m],yaw [rad]\n1574657205484000006,0.750000000,-1.250000000\n");
  EXPECT_EQ(text_of(folder.path() / "vision_heading.csv"),
            "#timestamp [ns],heading [rad],pitch [rad],sigma [rad]\n"
            "1574657205484000009,0.500000000,0.000000000,0.010000000\n");
  EXPECT_THAT(text_of(folder.path() / "summary.json"), HasSubstr("\"steps\": 1"));
}

TEST(RunDirectory, ReadsBackWhatWasWritten) {
  const testing::TemporaryFolder folder;
  write_small_run(folder.path() / "new" / "run", true);
  const RunDirectory run = RunDirectory::read(folder.path() / "new" / "run");
  ASSERT_EQ(run.fused.size(), 3U);
  EXPECT_EQ(run.fused[2].stamp_ns, kStart + 20'000'000);
  EXPECT_EQ(run.fused[2].position_m, Eigen::Vector3d(2.0, 0.25, 0.5));
  ASSERT_EQ(run.covariance.size(), 3U);
  EXPECT_DOUBLE_EQ(run.covariance[1].position_m2(0, 0), 0.04);
  EXPECT_DOUBLE_EQ(run.covariance[1].position_m2(1, 0), -0.01);
  EXPECT_DOUBLE_EQ(run.covariance[1].var_yaw_rad2, 0.0025);
  ASSERT_EQ(run.attitude.size(), 3U);
  EXPECT_DOUBLE_EQ(run.attitude[0].world_from_body.y(), -0.5);
  ASSERT_EQ(run.steps.size(), 1U);
  EXPECT_DOUBLE_EQ(run.steps[0].yaw_rad, -1.25);
  EXPECT_EQ(run.vision_heading.size(), 1U);
  EXPECT_EQ(run.summary.steps, 1U);
  EXPECT_DOUBLE_EQ(run.summary.distance_m, 0.75);
  EXPECT_DOUBLE_EQ(run.summary.speed_factor, 300.0);
}

TEST(RunWriter, LeavesNothingOfAnEarlierRun) {
  const testing::TemporaryFolder folder;
  write_small_run(folder.path(), true);
  write_small_run(folder.path(), false);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "vision_heading.csv"));
  EXPECT_TRUE(RunDirectory::read(folder.path()).vision_heading.empty());
}

TEST(RunWriter, LeavesOutAndCountsRowsThatAreNotNewer) {
  const testing::TemporaryFolder folder;
  RunWriter writer(folder.path(), {});
  writer.add_fused(pose_at(20, 1, 1));
  writer.add_fused(pose_at(20, 2, 2));
  writer.add_fused(pose_at(10, 3, 3));
  writer.finish({});
  EXPECT_EQ(writer.left_out(), 2U);
  EXPECT_EQ(RunDirectory::read(folder.path()).fused.size(), 1U);
}

TEST(RunWriter, SaysWhenTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "skipped: no /dev/full";
  const testing::TemporaryFolder folder;
  std::filesystem::create_symlink("/dev/full", folder.path() / "pdr.tum");
  RunWriter writer(folder.path(), {});
  try {
    for (int i = 0; i < 1000; ++i) writer.add_pdr(pose_at(i, i, i));
    writer.finish({});
    FAIL() << "no fault";
  } catch (const FileFault& fault) {
    EXPECT_THAT(fault.what(), HasSubstr("pdr.tum: cannot write: No space left on device; free"));
  }
}

TEST(RunWriter, SaysWhereItCannotWriteAtAll) {
  const testing::TemporaryFolder folder;
  folder.write("file", "");
  EXPECT_THROW(RunWriter(folder.path() / "file" / "run", {}), FileFault);
}

TEST(RunDirectory, IsStrictAboutItsFiles) {
  const testing::TemporaryFolder folder;
  EXPECT_THAT(fault_of_reading(folder.path() / "absent"), HasSubstr("no such folder"));
  EXPECT_THAT(fault_of_reading(folder.path()), HasSubstr("trajectory.tum: no such file; give"));
  write_small_run(folder.path(), true);
  folder.write("steps.csv", "#timestamp [ns],length [m],yaw [rad]\n1,0.7,0\n2,0.7");
  EXPECT_THAT(fault_of_reading(folder.path()), HasSubstr("1 torn (line 3); the run did not end"));
  folder.write("steps.csv", "#timestamp [ns],length [m],yaw [rad]\n1,nan,0\n");
  EXPECT_THAT(fault_of_reading(folder.path()), HasSubstr("1 non-finite (line 2)"));
  folder.write("steps.csv", "#timestamp [ns],length [m]\n1,0.7\n");
  EXPECT_THAT(fault_of_reading(folder.path()), HasSubstr("steps.csv:1:1: column 'yaw' is missing"));
  write_small_run(folder.path(), true);
  folder.write("summary.json", "{\"steps\": 3}");
  EXPECT_THAT(fault_of_reading(folder.path()), HasSubstr("summary.json"));
}

}  // namespace
}  // namespace vpdr::evaluation
