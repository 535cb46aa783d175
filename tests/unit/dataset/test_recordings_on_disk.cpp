// Every kind of recording that is at hand is read whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <set>

#include "core/rotation.hpp"
#include "dataset/recording.hpp"
#include "tests/support/recordings.hpp"

namespace vpdr::dataset {
namespace {

std::set<std::filesystem::path> folders_with_imu(const std::filesystem::path& root) {
  std::set<std::filesystem::path> folders;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (!entry.is_directory() || entry.path().filename() != "imu0") continue;
    const auto parent = entry.path().parent_path();
    folders.insert(parent.filename() == "mav0" ? parent.parent_path() : parent);
  }
  return folders;
}

/// The first recording of each set.
std::map<std::filesystem::path, std::filesystem::path> one_of_each(
    const std::set<std::filesystem::path>& folders) {
  std::map<std::filesystem::path, std::filesystem::path> sets;
  for (const auto& folder : folders) sets.emplace(folder.parent_path(), folder);
  return sets;
}

TEST(RecordingsOnDisk, OneOfEveryKindIsReadWithoutARefusedSample) {
  VPDR_REQUIRE_RECORDINGS(root);
  const auto folders = folders_with_imu(root);
  EXPECT_GE(folders.size(), 80U);
  const auto sets = one_of_each(folders);
  EXPECT_GE(sets.size(), 8U);
  for (const auto& [set, folder] : sets) {
    SCOPED_TRACE(folder.string());
    const Recording recording = read_recording(folder);
    EXPECT_GT(recording.imu.size(), 500U);
    const std::uint64_t duplicate = folder.filename() == "user1_armband" ? 1 : 0;
    EXPECT_EQ(recording.report.refused(), duplicate)
        << ::testing::PrintToString(recording.report.lines());
    const double seconds =
        to_seconds(recording.imu.back().stamp_ns - recording.imu.front().stamp_ns);
    EXPECT_GT(seconds, 5.0);
    EXPECT_LT(seconds, 3600.0);
  }
}

TEST(RecordingsOnDisk, BroadHasTruthAndMovement) {
  VPDR_REQUIRE_RECORDINGS(root);
  const Recording recording = read_recording(root / "ahrs/broad/35_disturbed_attached_magnet_4cm");
  ASSERT_TRUE(recording.truth.movement.has_value());
  ASSERT_EQ(recording.truth.movement->size(), 1U);
  EXPECT_EQ(recording.truth.movement->front().begin_ns, 46'326'000'000);
  EXPECT_EQ(recording.truth.movement->front().end_ns, 131'719'000'000);
  EXPECT_EQ(recording.truth.poses.size(), recording.imu.size());
}

TEST(RecordingsOnDisk, EurocHasImagesTruthAndCalibration) {
  VPDR_REQUIRE_RECORDINGS(root);
  const Recording recording = read_recording(root / "vision/euroc_mh01");
  EXPECT_EQ(recording.images.size(), 450U);
  ASSERT_TRUE(recording.camera.has_value());
  EXPECT_DOUBLE_EQ(recording.camera->fx, 458.654);
  EXPECT_EQ(recording.truth.poses.front().stamp_ns, 1403636580838560000);
}

TEST(RecordingsOnDisk, ImagesWithoutImuAreARecording) {
  VPDR_REQUIRE_RECORDINGS(root);
  for (const char* folder : {"vision/corridor_rgbd_lpvo", "vision/corridor_rgbd_lpvo/rgb"}) {
    const Recording recording = read_recording(root / folder);
    EXPECT_EQ(recording.images.size(), 220U);
    EXPECT_TRUE(recording.imu.empty());
    EXPECT_EQ(recording.report.notes.size(), 1U);
  }
}

TEST(RecordingsOnDisk, FlatPhonesHaveTheirMount) {
  VPDR_REQUIRE_RECORDINGS(root);
  Recording recording = read_recording(root / "walks/ilc20/site1_F4_5ddb655a9191710006b575b5");
  EXPECT_EQ(recording.truth.waypoints.size(), 12U);
  apply_mount(recording);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const ImuSample& sample : recording.imu) mean += sample.specific_force_mps2;
  mean /= static_cast<double>(recording.imu.size());
  EXPECT_GT(mean.z(), 9.0);
}

TEST(RecordingsOnDisk, MobilisedHasStepInstantsInsideItsBouts) {
  VPDR_REQUIRE_RECORDINGS(root);
  const Recording recording = read_recording(root / "walks/mobilised_waist/HA001_Test5_Trial1");
  EXPECT_EQ(recording.truth.steps.size(), 10U);
  EXPECT_EQ(recording.truth.strides.size(), 8U);
  EXPECT_EQ(recording.truth.steps.front().stamp_ns, 5'030'000'000);
  EXPECT_DOUBLE_EQ(*recording.about.height_m, 1.59);
  EXPECT_NEAR(recording.truth.strides.front().length_m, 1.1731, 1e-4);
}

TEST(RecordingsOnDisk, ReadingIsHundredsOfTimesFasterThanWalking) {
  VPDR_REQUIRE_RECORDINGS(root);
  double recorded_s = 0.0;
  const auto begin = std::chrono::steady_clock::now();
  for (const auto& folder : folders_with_imu(root / "walks/ilc20")) {
    const Recording recording = read_recording(folder);
    recorded_s += to_seconds(recording.imu.back().stamp_ns - recording.imu.front().stamp_ns);
  }
  const double took_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  RecordProperty("times_real_time", static_cast<int>(recorded_s / took_s));
  EXPECT_GT(recorded_s / took_s, 100.0);
}

}  // namespace
}  // namespace vpdr::dataset
