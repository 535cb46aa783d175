#include "vpdr/pipeline.hpp"

#include <algorithm>
#include <utility>

namespace vpdr::tool {
namespace {
/// A recording full of bad images names the first ones; vision counts the rest.
constexpr std::size_t kNamedProblems = 10;
}  // namespace

Pipeline::Pipeline(const PipelineConfig& config, std::optional<PipelineFrames> frames,
                   PipelineOutput& output)
    : output_(output),
      pdr_(config.pdr),
      attitudes_(config.vision.attitude),
      fusion_(config.fusion) {
  if (!frames) return;
  vision_.emplace(config.vision, frames->camera);
  frames_ = std::move(frames->source);
}

void Pipeline::process(const MagSample& sample) { pdr_.process(sample); }

void Pipeline::process(const ImuSample& sample) {
  if (pdr_.process(sample, pdr_output_) != Refusal::kNone) return;
  if (pdr_output_.attitude) {
    output_.take(*pdr_output_.attitude);
    attitudes_.add(*pdr_output_.attitude);
  }
  if (pdr_output_.step) {
    output_.take(*pdr_output_.step);
    fusion_.process(*pdr_output_.step);
  }
  if (pdr_output_.heading) fusion_.process(*pdr_output_.heading);
  process_due_frames();
  if (!pdr_output_.odometry) return;
  output_.take_pdr(*pdr_output_.odometry);
  fusion_.process(*pdr_output_.odometry);
  if (const auto fused = fusion_.latest()) output_.take_fused(*fused);
}

void Pipeline::process_due_frames() {
  if (!frames_) return;
  for (auto next = frames_->next_stamp(); next && attitudes_.is_due(*next);
       next = frames_->next_stamp()) {
    process(frames_->load());
  }
}

void Pipeline::process_frames_alone(const std::function<void(std::size_t)>& progress) {
  if (!frames_) return;
  for (std::size_t done = 1; frames_->next_stamp(); ++done) {
    process(frames_->load());
    progress(done);
  }
}

void Pipeline::process(const vision::Frame& frame) {
  if (!frame.problem.empty() && frame_problems_.size() < kNamedProblems) {
    frame_problems_.push_back(frame.problem);
  }
  const vision::VisionOutput seen =
      vision_->process(frame.image, frame.stamp_ns, attitudes_.at(frame.stamp_ns));
  if (seen.outcome == vision::FrameOutcome::kNotLater) return;
  output_.take(seen.heading);
  fusion_.process(seen.heading);
  if (seen.rate) fusion_.process(*seen.rate);
}

void play(const dataset::Recording& recording, Pipeline& pipeline,
          const std::function<void(double)>& progress) {
  if (recording.imu.empty()) {
    const auto frames = static_cast<double>(std::max<std::size_t>(1, recording.images.size()));
    pipeline.process_frames_alone(
        [&](std::size_t done) { progress(std::min(1.0, static_cast<double>(done) / frames)); });
    return;
  }
  std::size_t mags = 0;
  for (std::size_t i = 0; i < recording.imu.size(); ++i) {
    const ImuSample& sample = recording.imu[i];
    for (; mags < recording.mag.size() && recording.mag[mags].stamp_ns <= sample.stamp_ns; ++mags) {
      pipeline.process(recording.mag[mags]);
    }
    pipeline.process(sample);
    progress(static_cast<double>(i + 1) / static_cast<double>(recording.imu.size()));
  }
}

}  // namespace vpdr::tool
