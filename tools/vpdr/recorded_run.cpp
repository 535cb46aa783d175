#include "vpdr/recorded_run.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <utility>

#include "dataset/recording.hpp"
#include "evaluation/run_writer.hpp"
#include "vision/source/recorded_frames.hpp"
#include "vpdr/run_remarks.hpp"

namespace vpdr::tool {
namespace {

/// Hands the estimates to the files of the run.
class Files : public PipelineOutput {
 public:
  explicit Files(evaluation::RunWriter& writer) : writer_(writer) {}

  void take(const AttitudeEstimate& attitude) override { writer_.add_attitude(attitude); }
  void take(const StepEvent& step) override { writer_.add_step(step); }
  void take(const CorridorHeading& heading) override { writer_.add_vision_heading(heading); }
  void take_vision(const PoseEstimate& pose) override { writer_.add_vision(pose); }
  void take_pdr(const PoseEstimate& pose) override { writer_.add_pdr(pose); }
  void take_fused(const FusedPose& fused) override { writer_.add_fused(fused.pose); }

 private:
  evaluation::RunWriter& writer_;
};

template <class... Values>
std::string format(const char* pattern, Values... values) {
  const int size = std::snprintf(nullptr, 0, pattern, values...);
  std::string text(static_cast<std::size_t>(size), '\0');
  std::snprintf(text.data(), text.size() + 1, pattern, values...);
  return text;
}

double duration_of(const dataset::Recording& recording) {
  if (recording.imu.empty()) {
    if (recording.images.empty()) return 0.0;
    return to_seconds(recording.images.back().stamp_ns - recording.images.front().stamp_ns);
  }
  return to_seconds(recording.imu.back().stamp_ns - recording.imu.front().stamp_ns);
}

void append(std::vector<std::string>& lines, const std::vector<std::string>& more) {
  lines.insert(lines.end(), more.begin(), more.end());
}

std::string describe(const evaluation::Summary& summary, const Pipeline& pipeline,
                     const std::filesystem::path& out) {
  std::string text = format("%llu steps, %.1f m in %.1f s, %.0f times real time\n",
                            static_cast<unsigned long long>(summary.steps), summary.distance_m,
                            summary.duration_s, summary.speed_factor);
  if (const auto fused = pipeline.fusion().latest()) {
    const auto& position = fused->pose.position_m;
    const auto variance = fused->pose.covariance.diagonal();
    const bool north_known = pipeline.pdr().mag_gate().accepted() > 0;
    text +=
        format("ended at %s %.2f m, %s %.2f m (1 sigma %.2f m, %.2f m), mode %s%s\n",
               north_known ? "east" : "x", position.x(), north_known ? "north" : "y", position.y(),
               std::sqrt(variance[0]), std::sqrt(variance[1]), name_of(fused->mode),
               north_known ? "" : "; no magnetometer: x need not be east");
  }
  if (pipeline.vision()) {
    const fusion::FusionDiagnostics d = pipeline.fusion().diagnostics();
    text += format("vision: %llu frames with a corridor, %llu heading rates used, %llu refused\n",
                   static_cast<unsigned long long>(d.corridors_found),
                   static_cast<unsigned long long>(d.rates.accepted),
                   static_cast<unsigned long long>(d.rates.gated));
  }
  return text + "result in " + out.string() + "\n";
}

std::optional<PipelineFrames> frames_of(const dataset::Recording& recording,
                                        const Configuration& configuration,
                                        std::vector<std::string>& warnings) {
  if (recording.images.empty() && !recording.video) return std::nullopt;
  auto opened = vision::open_recorded_frames(recording, configuration.frames.video_offset_s);
  if (opened.camera) return PipelineFrames{*opened.camera, std::move(opened.source)};
  warnings.push_back(opened.idle_reason + "; " + opened.idle_remedy);
  return std::nullopt;
}

}  // namespace

RunReport run_recording(const std::filesystem::path& folder, const std::filesystem::path& out,
                        const Configuration& configuration, const RunChoices& choices,
                        const std::function<void(double)>& progress) {
  dataset::Recording recording =
      dataset::read_recording(folder, {.images = choices.vision, .truth = false});
  if (const std::string& file = configuration.frames.calibration; !file.empty()) {
    recording.camera = dataset::read_camera_calibration(file);
  }
  dataset::apply_mount(recording);
  RunReport report;
  report.warnings = recording.report.lines();
  append(report.warnings, sensor_remarks(recording));
  append(report.warnings, about_remarks(recording.about));
  auto frames = frames_of(recording, configuration, report.warnings);
  evaluation::RunWriter writer(out, {.vision_heading = frames.has_value()});
  Files files(writer);
  Pipeline pipeline(told_by(recording, configuration.cores), std::move(frames), files);
  const auto start = std::chrono::steady_clock::now();
  play(recording, pipeline, progress);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;

  report.summary.steps = pipeline.pdr().step_count();
  report.summary.duration_s = duration_of(recording);
  report.summary.speed_factor = report.summary.duration_s / std::max(taken.count(), 1e-9);
  const auto fused = pipeline.fusion().latest();
  report.summary.distance_m = fused ? fused->distance_m : 0.0;
  writer.finish(report.summary);
  evaluation::RunInfo info;
  info.title = "vpdr run";
  info.recording = std::filesystem::canonical(folder);
  info.services = configuration.services;
  evaluation::write_run_info(out, info);
  append(report.warnings, pipeline.frame_problems());
  append(report.warnings, unused_remarks(pipeline));
  report.text = describe(report.summary, pipeline, out);
  return report;
}

}  // namespace vpdr::tool
