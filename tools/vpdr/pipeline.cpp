#include "vpdr/pipeline.hpp"

#include <opencv2/imgcodecs.hpp>
#include <utility>

namespace vpdr::tool {

Pipeline::Pipeline(const PipelineConfig& config, const std::optional<vision::CameraModel>& camera,
                   PipelineOutput& output)
    : output_(output), pdr_(config.pdr), fusion_(config.fusion) {
  if (camera) vision_.emplace(config.vision, *camera);
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

void Pipeline::process(Frame frame) {
  if (vision_) frames_.push_back(std::move(frame));
}

void Pipeline::process_due_frames() {
  for (; !frames_.empty() && attitudes_.is_due(frames_.front().stamp_ns); frames_.pop_front()) {
    const Frame& frame = frames_.front();
    const vision::VisionOutput seen =
        vision_->process(frame.load(), frame.stamp_ns, attitudes_.at(frame.stamp_ns));
    if (seen.outcome == vision::FrameOutcome::kNotLater) continue;
    output_.take(seen.heading);
    fusion_.process(seen.heading);
    if (seen.rate) fusion_.process(*seen.rate);
  }
}

void play(const dataset::Recording& recording, Pipeline& pipeline,
          const std::function<void(double)>& progress) {
  std::size_t mags = 0;
  std::size_t frames = 0;
  for (std::size_t i = 0; i < recording.imu.size(); ++i) {
    const ImuSample& sample = recording.imu[i];
    for (; mags < recording.mag.size() && recording.mag[mags].stamp_ns <= sample.stamp_ns; ++mags) {
      pipeline.process(recording.mag[mags]);
    }
    for (; frames < recording.images.size() && recording.images[frames].stamp_ns <= sample.stamp_ns;
         ++frames) {
      const dataset::ImageEntry& image = recording.images[frames];
      pipeline.process(Frame{image.stamp_ns, [file = image.file.string()] {
                               return cv::imread(file, cv::IMREAD_GRAYSCALE);
                             }});
    }
    pipeline.process(sample);
    progress(static_cast<double>(i + 1) / static_cast<double>(recording.imu.size()));
  }
}

}  // namespace vpdr::tool
