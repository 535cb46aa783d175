#include "vpdr/pipeline.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include "core/reading.hpp"

namespace vpdr::tool {
namespace {
/// A recording full of bad images names the first ones; vision counts the rest.
constexpr std::size_t kNamedProblems = 10;
}  // namespace

Pipeline::Pipeline(const PipelineConfig& config, std::optional<PipelineFrames> frames,
                   PipelineOutput& output)
    : output_(output),
      pdr_(config.pdr),
      attitudes_(config.vision.heading.attitude),
      fusion_(config.fusion) {
  if (!frames) return;
  vision_.emplace(config.vision, frames->camera);
  frames_ = std::move(frames->source);
}

void Pipeline::process(const MagSample& sample) { pdr_.process(sample); }

void Pipeline::process(const PressureSample& sample) { pdr_.process(sample); }

void Pipeline::process(const ImuSample& sample) {
  if (pdr_.process(sample, pdr_output_) != Refusal::kNone) return;
  if (pdr_output_.attitude) {
    output_.take(*pdr_output_.attitude);
    attitudes_.add(*pdr_output_.attitude);
  }
  if (pdr_output_.step) {
    output_.take(*pdr_output_.step);
    fusion_.process(*pdr_output_.step);
    if (vision_) vision_->add(*pdr_output_.step);
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
  const auto attitude = attitudes_.at(frame.stamp_ns);
  const bool due = vision_->heading_is_due(frame.stamp_ns);
  // Without an attitude the corridor's vertical is what motion has.
  std::optional<Eigen::Vector3d> up_camera;
  if (due && !attitude) up_camera = look_for_heading(frame, attitude);
  const vision::OdometryOutput moved =
      vision_->look_for_motion(frame.image, frame.stamp_ns, attitude, up_camera);
  if (moved.motion) output_.take(*moved.motion);
  if (moved.odometry) output_.take_vision(*moved.odometry);
  if (due && attitude) look_for_heading(frame, attitude);
}

std::optional<Eigen::Vector3d> Pipeline::look_for_heading(
    const vision::Frame& frame, const std::optional<vision::AttitudePrior>& attitude) {
  const vision::VisionOutput seen =
      vision_->look_for_heading(frame.image, frame.stamp_ns, attitude);
  if (seen.outcome == vision::FrameOutcome::kNotLater) return std::nullopt;
  output_.take(seen.heading);
  fusion_.process(seen.heading);
  if (seen.rate) fusion_.process(*seen.rate);
  if (seen.outcome != vision::FrameOutcome::kFound) return std::nullopt;
  return seen.frame->camera_from_corridor.col(2);
}

PipelineConfig told_by(const dataset::Recording& recording, PipelineConfig config) {
  const dataset::About& about = recording.about;
  if (about.declination_rad != 0.0) {
    config.pdr.attitude.magnetic.declination_rad = about.declination_rad;
  }
  if (config.pdr.carry == pdr::Carry::kUnknown) config.pdr.carry = pdr::carry_named(about.carry);
  if (config.pdr.person.height_m == 0.0) {
    config.pdr.person.height_m = about.height_m.value_or(0.0);
  }
  return config;
}

void play(const dataset::Recording& recording, Pipeline& pipeline,
          const std::function<void(double)>& progress) {
  if (recording.imu.empty()) {
    const auto frames = static_cast<double>(std::max<std::size_t>(1, recording.images.size()));
    pipeline.process_frames_alone(
        [&](std::size_t done) { progress(std::min(1.0, static_cast<double>(done) / frames)); });
    return;
  }
  const auto readings = merge_by_stamp(recording.imu, recording.mag, recording.pressure);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    std::visit([&](const auto& sample) { pipeline.process(sample); }, readings[i]);
    progress(static_cast<double>(i + 1) / static_cast<double>(readings.size()));
  }
}

}  // namespace vpdr::tool
