#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "core/errors.hpp"
#include "core/rotation.hpp"
#include "dataset/recording.hpp"
#include "simulation/recording_writer.hpp"

namespace vpdr::simulation {
namespace {

namespace fs = std::filesystem;

class RecordingWriter : public testing::Test {
 protected:
  RecordingWriter() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) /
              ("vpdr_writer_" + std::string(test->name()) + std::to_string(::getpid()));
    fs::remove_all(folder_);
  }
  ~RecordingWriter() override { fs::remove_all(folder_); }

  static SimulatedWalk small_walk(std::uint64_t seed) {
    WalkOptions options;
    options.seed = seed;
    options.duration_s = 8.0;
    options.camera_rate_hz = 1.0;
    options.camera.width = 64;
    options.camera.height = 48;
    options.camera.fx = options.camera.fy = 46.0;
    options.camera.cx = 31.5;
    options.camera.cy = 23.5;
    return simulate_walk(options);
  }

  fs::path folder_;
};

TEST_F(RecordingWriter, WhatIsWrittenReadsBackTheSame) {
  const SimulatedWalk walk = small_walk(1);
  double last = 0.0;
  write_recording(walk, folder_, {}, [&](double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_EQ(last, 1.0);

  const dataset::Recording read = dataset::read_recording(folder_);
  EXPECT_EQ(read.report.refused(), 0u);
  ASSERT_EQ(read.imu.size(), walk.imu.size());
  for (std::size_t i = 0; i < walk.imu.size(); ++i) {
    ASSERT_EQ(read.imu[i].stamp_ns, walk.imu[i].stamp_ns);
    ASSERT_LT((read.imu[i].specific_force_mps2 - walk.imu[i].specific_force_mps2).norm(), 1e-6);
    ASSERT_LT((read.imu[i].angular_velocity_radps - walk.imu[i].angular_velocity_radps).norm(),
              1e-7);
  }
  ASSERT_EQ(read.mag.size(), walk.mag.size());
  EXPECT_LT((read.mag.back().field_ut - walk.mag.back().field_ut).norm(), 1e-4);
  ASSERT_EQ(read.pressure.size(), walk.pressure.size());
  EXPECT_NEAR(read.pressure.back().pressure_pa, walk.pressure.back().pressure_pa, 1e-3);
}

TEST_F(RecordingWriter, TruthAndPersonReadBackTheSame) {
  const SimulatedWalk walk = small_walk(2);
  write_recording(walk, folder_);
  const dataset::Recording read = dataset::read_recording(folder_);
  ASSERT_EQ(read.truth.poses.size(), 801u);
  for (const auto& pose : read.truth.poses) {
    const MotionState state = walk.state_at(pose.stamp_ns);
    EXPECT_LT((pose.position_m - state.position_m).norm(), 1e-5);
    EXPECT_LT(log_rotation(pose.world_from_sensor.conjugate() * state.world_from_body).norm(),
              1e-6);
  }
  ASSERT_EQ(read.truth.steps.size(), walk.steps.size());
  EXPECT_EQ(read.truth.steps.front().stamp_ns, walk.steps.front().stamp_ns);
  EXPECT_EQ(read.about.carry, "head");
  EXPECT_TRUE(read.about.mount.isIdentity());
  ASSERT_TRUE(read.about.true_steps && read.about.height_m);
  EXPECT_EQ(*read.about.true_steps, static_cast<double>(walk.steps.size()));
  EXPECT_NEAR(*read.about.height_m, 1.72, 1e-9);
}

TEST_F(RecordingWriter, PicturesAndCalibrationReadBackTheSame) {
  const SimulatedWalk walk = small_walk(3);
  write_recording(walk, folder_);
  const dataset::Recording read = dataset::read_recording(folder_);
  ASSERT_EQ(read.images.size(), 8u);
  const SceneRenderer renderer(walk.plan, walk.options.camera, walk.options.seed);
  for (std::size_t k = 0; k < read.images.size(); ++k) {
    EXPECT_EQ(read.images[k].stamp_ns, walk.frames[k]);
    const cv::Mat image = cv::imread(read.images[k].file.string(), cv::IMREAD_UNCHANGED);
    const cv::Mat truth = renderer.render(walk.world_from_camera(walk.frames[k]), k);
    ASSERT_EQ(image.type(), CV_8UC1);
    ASSERT_EQ(image.size(), truth.size());
    double difference = 0.0;
    for (int j = 0; j < truth.rows; ++j) {
      for (int i = 0; i < truth.cols; ++i) {
        difference += std::abs(image.at<std::uint8_t>(j, i) - truth.at<std::uint8_t>(j, i));
      }
    }
    EXPECT_LT(difference / static_cast<double>(truth.total()), 4.0);  // what JPEG costs
  }
  ASSERT_TRUE(read.camera);
  EXPECT_EQ(read.camera->width, 64);
  EXPECT_EQ(read.camera->fx, 46.0);
  EXPECT_EQ(read.camera->rate_hz, 1.0);
  EXPECT_EQ(read.camera->distortion, dataset::Distortion::kRadialTangential);
  EXPECT_NEAR(read.camera->coefficients.at(0), -0.06, 1e-12);
  EXPECT_TRUE(
      read.camera->body_from_camera.isApprox(walk.options.camera.body_from_camera.matrix(), 1e-9));
}

TEST_F(RecordingWriter, WithoutPicturesThereIsNoCamera) {
  RecordingOptions options;
  options.images = false;
  write_recording(small_walk(1), folder_, options);
  EXPECT_FALSE(fs::exists(folder_ / "cam0"));
  EXPECT_TRUE(dataset::read_recording(folder_).images.empty());
}

TEST_F(RecordingWriter, WritesAnewOverAnEarlierSimulatedWalk) {
  write_recording(small_walk(1), folder_);
  const SimulatedWalk second = small_walk(2);
  RecordingOptions options;
  options.images = false;
  write_recording(second, folder_, options);
  const dataset::Recording read = dataset::read_recording(folder_);
  EXPECT_TRUE(read.images.empty());  // those of the first walk are gone
  EXPECT_LT((read.imu.back().specific_force_mps2 - second.imu.back().specific_force_mps2).norm(),
            1e-6);
}

TEST_F(RecordingWriter, LeavesOtherFoldersAlone) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "thesis.txt") << "years of work\n";
  EXPECT_THROW(write_recording(small_walk(1), folder_), FileFault);
  EXPECT_TRUE(fs::exists(folder_ / "thesis.txt"));
  EXPECT_FALSE(fs::exists(folder_ / "imu0"));
}

TEST_F(RecordingWriter, NamesThePlaceItCannotWriteTo) {
  std::ofstream(folder_) << "a file where a folder should be\n";
  try {
    write_recording(small_walk(1), folder_ / "walk");
    FAIL() << "no fault";
  } catch (const FileFault& fault) {
    EXPECT_NE(std::string(fault.what()).find("walk"), std::string::npos);
    EXPECT_EQ(fault.code(), ExitCode::kFile);
  }
}

}  // namespace
}  // namespace vpdr::simulation
