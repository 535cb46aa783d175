#pragma once
// All cores in one process, no DDS: samples and frames in, estimates out, in the order of sensor
// time and as fast as the machine goes. The cores see the same measurements as in the five
// services, so they give the same numbers.
//
//   Pipeline pipeline(config, camera, output);
//   play(recording, pipeline, progress);       // or process() by hand
//
// At equal stamps a magnetometer sample goes before the inertial one. A frame waits for the first
// attitude at or after its stamp. Not thread-safe.
#include <deque>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>

#include "core/estimates.hpp"
#include "core/samples.hpp"
#include "dataset/recording.hpp"
#include "fusion/core/fusion.hpp"
#include "pdr/core/pdr.hpp"
#include "vision/core/attitude_track.hpp"
#include "vision/core/vanishing_point_heading.hpp"

namespace vpdr::tool {

struct PipelineConfig {
  pdr::PdrConfig pdr;
  vision::VisionConfig vision;
  fusion::FusionConfig fusion;
};

/// Receives what the cores give. The default does nothing, so take what you need.
class PipelineOutput {
 public:
  virtual ~PipelineOutput() = default;
  virtual void take(const AttitudeEstimate&) {}
  virtual void take(const StepEvent&) {}
  virtual void take(const CorridorHeading&) {}
  virtual void take_pdr(const PoseEstimate&) {}
  virtual void take_fused(const FusedPose&) {}
};

/// A frame whose pixels are loaded when they are needed; an empty image is one that cannot be
/// decoded, which vision counts.
struct Frame {
  TimestampNs stamp_ns = 0;
  std::function<cv::Mat()> load;
};

class Pipeline {
 public:
  /// Without a camera frames are not looked at. `output` must live as long as the pipeline.
  Pipeline(const PipelineConfig& config, const std::optional<vision::CameraModel>& camera,
           PipelineOutput& output);

  void process(const MagSample& sample);
  void process(const ImuSample& sample);
  /// Frames come in the order of their stamps.
  void process(Frame frame);

  [[nodiscard]] const pdr::Pdr& pdr() const { return pdr_; }
  [[nodiscard]] const fusion::Fusion& fusion() const { return fusion_; }
  [[nodiscard]] const std::optional<vision::VanishingPointHeading>& vision() const {
    return vision_;
  }

 private:
  void process_due_frames();

  PipelineOutput& output_;
  pdr::Pdr pdr_;
  pdr::PdrOutput pdr_output_;
  std::optional<vision::VanishingPointHeading> vision_;
  vision::AttitudeTrack attitudes_;
  std::deque<Frame> frames_;
  fusion::Fusion fusion_;
};

/// Gives a recording (in body axes) to the pipeline, merged by stamp. `progress` gets the share
/// done, 0 to 1.
void play(const dataset::Recording& recording, Pipeline& pipeline,
          const std::function<void(double)>& progress);

}  // namespace vpdr::tool
