#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/errors.hpp"
#include "dataset/truth_tables.hpp"
#include "tests/support/temporary_folder.hpp"

namespace vpdr::dataset {
namespace {

class TruthFile : public ::testing::Test {
 protected:
  testing::TemporaryFolder folder_;
  ReadReport report_;
};

TEST_F(TruthFile, GroundtruthMayBePartlyUnknown) {
  const auto poses = read_groundtruth_table(
      folder_.write("g.csv",
                    "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w,q_x,q_y,q_z\n"
                    "1,nan,nan,nan,0,0,0,2\n2,1,2,3,nan,nan,nan,nan\n3,1,2,3,0,0,0,0\n"),
      report_);
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_FALSE(poses[0].has_position());
  ASSERT_TRUE(poses[0].has_attitude());
  EXPECT_DOUBLE_EQ(poses[0].world_from_sensor.z(), 1.0);  // normalised
  EXPECT_TRUE(poses[1].has_position());
  EXPECT_FALSE(poses[1].has_attitude());
  EXPECT_FALSE(poses[2].has_attitude());
}

TEST_F(TruthFile, GroundtruthKnowsEurocsColumns) {
  const auto poses = read_groundtruth_table(
      folder_.write("g.csv",
                    "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], "
                    "q_RS_y [], q_RS_z [], v_RS_R_x [m s^-1], v_RS_R_y [m s^-1]\n"
                    "5,4.5,-1.8,0.8,1,0,0,0,9,9\n"),
      report_);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].position_m, Eigen::Vector3d(4.5, -1.8, 0.8));
}

TEST_F(TruthFile, TumIsExactInTimeAndXyzwInOrder) {
  const auto poses = read_tum(folder_.write("t.txt",
                                            "# timestamp(s) tx ty tz qx qy qz qw\n"
                                            "1403636580.838555648 1 2 3 0 0 1 0\r\n"
                                            "1403636580.838555648 1 2 3 0 0 1 0\n"
                                            "1403636581.5 bad\n"
                                            "1403636582 4 5"),
                              report_);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].stamp_ns, 1403636580838555648);
  EXPECT_DOUBLE_EQ(poses[0].world_from_sensor.z(), 1.0);
  EXPECT_EQ(report_.files[0].refused(RowFault::kDuplicate), 1U);
  EXPECT_EQ(report_.files[0].refused(RowFault::kMalformed), 1U);
  EXPECT_EQ(report_.files[0].refused(RowFault::kTorn), 1U);
}

TEST_F(TruthFile, AMovementMarkHoldsUntilTheNextRow) {
  const auto moving = read_movement_table(
      folder_.write("m.csv",
                    "#timestamp [ns],movement (holds until the next row)\n0,0\n10,1\n20,0\n30,1\n"),
      report_);
  ASSERT_EQ(moving.size(), 2U);
  EXPECT_FALSE(moving[0].contains(9));
  EXPECT_TRUE(moving[0].contains(10));
  EXPECT_TRUE(moving[0].contains(19));
  EXPECT_FALSE(moving[0].contains(20));
  EXPECT_TRUE(moving[1].contains(std::numeric_limits<TimestampNs>::max() - 1));
}

TEST_F(TruthFile, StepLengthsMayBeUnknown) {
  const auto steps = read_step_table(
      folder_.write("s.csv", "#timestamp [ns],length [m]\n1,nan\n2,0.7\n"), report_);
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_TRUE(std::isnan(steps[0].length_m));
  EXPECT_DOUBLE_EQ(steps[1].length_m, 0.7);
}

constexpr const char* kReference = R"({"INDIP": {"MicroWB": [], "Fs": 100},
 "Stereophoto": {"Fs": 100, "MicroWB": {"Start": 5.0, "End": 7.0,
  "InitialContact_Event": [5.0, 5.5, NaN, 6.5, 7.0],
  "Step_Length": [0.5, NaN, 0.6, 0.7],
  "Stride_Length": [1.1, 1.2, 1.3]}}})";

TEST_F(TruthFile, StepReferenceTakesTheSystemThatSawABout) {
  Truth truth;
  read_step_reference(folder_.write("reference.json", kReference), 1'000'000'000, truth, report_);
  ASSERT_EQ(truth.walking_bouts->size(), 1U);
  EXPECT_TRUE(truth.walking_bouts->front().contains(6'000'000'000));
  ASSERT_EQ(truth.steps.size(), 4U);  // the contact at an unknown time is left out
  EXPECT_EQ(truth.steps[0].stamp_ns, 6'000'000'000);
  EXPECT_TRUE(std::isnan(truth.steps[0].length_m));
  EXPECT_DOUBLE_EQ(truth.steps[1].length_m, 0.5);
  EXPECT_DOUBLE_EQ(truth.steps[2].length_m, 0.6);
  ASSERT_EQ(truth.strides.size(), 1U);  // contacts 1 and 3; the others touch the unknown one
  EXPECT_EQ(truth.strides[0].begin_ns, 6'500'000'000);
  EXPECT_EQ(truth.strides[0].end_ns, 7'500'000'000);
  EXPECT_DOUBLE_EQ(truth.strides[0].length_m, 1.2);
}

TEST_F(TruthFile, AnotherJsonIsNamed) {
  Truth truth;
  EXPECT_THROW(read_step_reference(folder_.write("reference.json", "{\"a\": "), 0, truth, report_),
               FileFault);
}

}  // namespace
}  // namespace vpdr::dataset
