#pragma once
// All cores in one process, no DDS: samples and frames in, estimates out, in the order of sensor
// time and as fast as the machine goes. The cores see the same measurements as in the five
// services, so they give the same numbers.
//
//   Pipeline pipeline(config, open_recorded_frames(recording, 0.0), output);
//   play(recording, pipeline, progress);       // or process() by hand
//
// At equal stamps magnetometer and barometer go before the inertial sample. A frame waits for the
// first attitude at or after its stamp; those after the last attitude are not looked at. Not
// thread-safe.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/estimates.hpp"
#include "core/samples.hpp"
#include "dataset/recording.hpp"
#include "fusion/core/fusion.hpp"
#include "pdr/core/pdr.hpp"
#include "vision/core/attitude_track.hpp"
#include "vision/core/frame_analysis.hpp"
#include "vision/source/frame_source.hpp"

namespace vpdr::tool {

struct PipelineConfig {
  pdr::PdrConfig pdr;
  vision::AnalysisConfig vision;
  fusion::FusionConfig fusion;
};

/// The camera and what it saw.
struct PipelineFrames {
  vision::CameraModel camera;
  std::unique_ptr<vision::FrameSource> source;
};

/// Receives what the cores give. The default does nothing, so take what you need.
class PipelineOutput {
 public:
  virtual ~PipelineOutput() = default;
  virtual void take(const AttitudeEstimate& /*attitude*/) {}
  virtual void take(const StepEvent& /*step*/) {}
  virtual void take(const CorridorHeading& /*heading*/) {}
  virtual void take(const MotionEstimate& /*motion*/) {}
  virtual void take_vision(const PoseEstimate& /*odometry*/) {}
  virtual void take_pdr(const PoseEstimate& /*odometry*/) {}
  virtual void take_fused(const FusedPose& /*fused*/) {}
};

class Pipeline {
 public:
  /// `output` must live as long as the pipeline.
  Pipeline(const PipelineConfig& config, std::optional<PipelineFrames> frames,
           PipelineOutput& output);

  void process(const MagSample& sample);
  void process(const PressureSample& sample);
  void process(const ImuSample& sample);
  /// Looks at all frames that are left, none of them with an attitude: there are no samples.
  /// `progress` gets the number done.
  void process_frames_alone(const std::function<void(std::size_t)>& progress);

  [[nodiscard]] const pdr::Pdr& pdr() const { return pdr_; }
  [[nodiscard]] const fusion::Fusion& fusion() const { return fusion_; }
  [[nodiscard]] const std::optional<vision::FrameAnalysis>& vision() const { return vision_; }
  /// Why frames could not be had: the first ones, a line each.
  [[nodiscard]] const std::vector<std::string>& frame_problems() const { return frame_problems_; }

 private:
  void process_due_frames();
  void process(const vision::Frame& frame);
  std::optional<Eigen::Vector3d> look_for_heading(
      const vision::Frame& frame, const std::optional<vision::AttitudePrior>& attitude);

  PipelineOutput& output_;
  pdr::Pdr pdr_;
  pdr::PdrOutput pdr_output_;
  std::unique_ptr<vision::FrameSource> frames_;
  std::optional<vision::FrameAnalysis> vision_;
  vision::AttitudeTrack attitudes_;
  std::vector<std::string> frame_problems_;
  fusion::Fusion fusion_;
};

/// The configuration with what the recording tells of place and walker where it says nothing: as
/// vpdr run and vpdr up have it.
PipelineConfig told_by(const dataset::Recording& recording, PipelineConfig config);

/// Gives the samples of a recording (in body axes) to the pipeline, merged by stamp; of a recording
/// without inertial samples, its frames. `progress` gets the share done, 0 to 1.
void play(const dataset::Recording& recording, Pipeline& pipeline,
          const std::function<void(double)>& progress);

}  // namespace vpdr::tool
