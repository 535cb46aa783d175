#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <vector>

#include "simulation/walk.hpp"
#include "vision/source/simulated_source.hpp"
#include "vpdr/pipeline.hpp"
#include "vpdr/run_remarks.hpp"

namespace vpdr::tool {
namespace {

struct Kept : PipelineOutput {
  void take(const StepEvent& step) override { steps.push_back(step); }
  void take(const CorridorHeading& heading) override { headings.push_back(heading); }
  void take_fused(const FusedPose& pose) override { fused.push_back(pose); }
  std::vector<StepEvent> steps;
  std::vector<CorridorHeading> headings;
  std::vector<FusedPose> fused;
};

dataset::Recording simulated(double duration_s) {
  simulation::WalkOptions options;
  options.duration_s = duration_s;
  const simulation::SimulatedWalk walk = simulation::simulate_walk(options);
  dataset::Recording recording;
  recording.imu = walk.imu;
  recording.mag = walk.mag;
  return recording;
}

/// Grey frames at given stamps: no corridor in them, but each must be accounted for.
class GreyFrames : public vision::FrameSource {
 public:
  explicit GreyFrames(std::vector<TimestampNs> stamps) : stamps_(std::move(stamps)) {}
  [[nodiscard]] std::optional<TimestampNs> next_stamp() const override {
    if (next_ == stamps_.size()) return std::nullopt;
    return stamps_[next_];
  }
  vision::Frame load() override {
    vision::Frame frame{stamps_[next_++], cv::Mat(480, 640, CV_8UC1, cv::Scalar(128)), {}};
    if (next_ == 2) frame = {frame.stamp_ns, {}, "frame.jpg: torn; copy it again"};
    return frame;
  }

 private:
  std::vector<TimestampNs> stamps_;
  std::size_t next_ = 0;
};

TEST(Pipeline, WalksASimulatedWalk) {
  const dataset::Recording recording = simulated(30.0);
  Kept kept;
  Pipeline pipeline({}, std::nullopt, kept);
  double last_share = 0.0;
  play(recording, pipeline, [&last_share](double share) {
    EXPECT_GE(share, last_share);
    last_share = share;
  });
  EXPECT_EQ(last_share, 1.0);
  EXPECT_GT(kept.steps.size(), 30U);
  ASSERT_FALSE(kept.fused.empty());
  EXPECT_EQ(kept.fused.back().pose.stamp_ns, recording.imu.back().stamp_ns);
  EXPECT_EQ(kept.fused.back().mode, FusionMode::kInertial);
  EXPECT_GT(kept.fused.back().distance_m, 15.0);
}

TEST(Pipeline, SameRecordingGivesTheSameNumbers) {
  const dataset::Recording recording = simulated(20.0);
  Kept first;
  Kept second;
  for (Kept* kept : {&first, &second}) {
    Pipeline pipeline({}, std::nullopt, *kept);
    play(recording, pipeline, [](double) {});
  }
  ASSERT_EQ(first.fused.size(), second.fused.size());
  EXPECT_EQ(first.fused.back().pose.position_m, second.fused.back().pose.position_m);
  EXPECT_EQ(first.fused.back().pose.covariance, second.fused.back().pose.covariance);
}

TEST(Pipeline, FrameWaitsForItsAttitudeAndEachIsAccountedFor) {
  const dataset::Recording recording = simulated(10.0);
  const TimestampNs begin = recording.imu.front().stamp_ns;
  const TimestampNs end = recording.imu.back().stamp_ns;
  simulation::WalkOptions options;
  Kept kept;
  Pipeline pipeline({},
                    PipelineFrames{vision::make_camera(options.camera),
                                   std::make_unique<GreyFrames>(std::vector<TimestampNs>{
                                       begin + to_ns(1.0), begin + to_ns(1.1), begin + to_ns(2.0),
                                       end, end + to_ns(0.1)})},
                    kept);
  for (const ImuSample& sample : recording.imu) {
    pipeline.process(sample);
    for (const CorridorHeading& heading : kept.headings) {
      ASSERT_LE(heading.stamp_ns, sample.stamp_ns);
    }
  }
  // The last one lies after the last attitude.
  ASSERT_EQ(kept.headings.size(), 4U);
  for (const CorridorHeading& heading : kept.headings) EXPECT_FALSE(heading.found);
  ASSERT_EQ(pipeline.frame_problems().size(), 1U);
  EXPECT_EQ(pipeline.frame_problems()[0], "frame.jpg: torn; copy it again");
  ASSERT_EQ(unused_remarks(pipeline).size(), 1U);
  EXPECT_EQ(unused_remarks(pipeline)[0], "vision: 4 of 4 frames refused: 1 empty, 3 featureless");
}

TEST(RunRemarks, AWholeWalkHasNone) {
  const dataset::Recording recording = simulated(30.0);
  Kept kept;
  Pipeline pipeline({}, std::nullopt, kept);
  play(recording, pipeline, [](double) {});
  EXPECT_EQ(sensor_remarks(recording), std::vector<std::string>());
  EXPECT_EQ(unused_remarks(pipeline), std::vector<std::string>());
}

TEST(RunRemarks, WrongUnitsAreNamed) {
  dataset::Recording recording = simulated(30.0);
  for (ImuSample& sample : recording.imu) sample.specific_force_mps2 /= kGravityMps2;
  for (MagSample& sample : recording.mag) sample.field_ut *= 1000.0;
  Kept kept;
  Pipeline pipeline({}, std::nullopt, kept);
  play(recording, pipeline, [](double) {});
  const auto found = sensor_remarks(recording);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_NE(found[0].find("the accelerometer is read in g"), std::string::npos) << found[0];
  EXPECT_NE(found[1].find("uT; the Earth's is 22 to 67"), std::string::npos) << found[1];
  const std::string all = std::to_string(recording.mag.size());
  EXPECT_EQ(unused_remarks(pipeline),
            std::vector<std::string>{"magnetometer: 0 of " + all + " readings used: " + all +
                                     " out_of_range; check the unit"});
}

}  // namespace
}  // namespace vpdr::tool
