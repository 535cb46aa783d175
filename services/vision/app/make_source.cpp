#include "vision/app/make_source.hpp"

#include "core/errors.hpp"
#include "core/host_clock.hpp"
#include "dataset/recording.hpp"
#include "vision/app/topic_frames.hpp"
#include "vision/source/live_camera.hpp"
#include "vision/source/make_camera.hpp"
#include "vision/source/prefetching_source.hpp"
#include "vision/source/recorded_frames.hpp"
#include "vision/source/simulated_source.hpp"

namespace vpdr::vision {
namespace {

constexpr std::size_t kFramesAhead = 3;

// "+y,-x,+z": the sensor axes that point forward, left and up.
Eigen::Matrix3d mount_of(const std::string& axes) {
  const std::size_t first = axes.find(',');
  const std::size_t second = axes.find(',', first + 1);
  if (first != std::string::npos && second != std::string::npos) {
    const std::string left = axes.substr(first + 1, second - first - 1);
    const std::string up = axes.substr(second + 1);
    const auto mount = dataset::mount_from_axes(axes.substr(0, first), up);
    const auto same = dataset::mount_from_axes(left, up);
    // Turned by 90 degrees to the left, forward becomes left.
    if (mount && same && same->row(0) == mount->row(1)) return *mount;
  }
  throw ConfigurationFault("vision.mount.axes: '" + axes +
                           "' is no right-handed forward, left, up; write it as +y,-x,+z");
}

dataset::Recording read(const SourceSettings& settings) {
  dataset::ReadOptions options;
  options.truth = false;
  if (!settings.mount.empty()) options.mount = mount_of(settings.mount);
  dataset::Recording recording = dataset::read_recording(settings.recording, options);
  if (!settings.calibration.empty()) {
    recording.camera = dataset::read_camera_calibration(settings.calibration);
  }
  dataset::apply_mount(recording);
  return recording;
}

OpenedFrames open_recording(const SourceSettings& settings) {
  RecordedFrames frames = open_recorded_frames(read(settings), settings.video_offset_s);
  OpenedFrames opened;
  opened.camera = std::move(frames.camera);
  opened.recorded = std::move(frames.source);
  opened.idle_reason = std::move(frames.idle_reason);
  opened.idle_remedy = std::move(frames.idle_remedy);
  return opened;
}

OpenedFrames open_simulation(const SourceSettings& settings) {
  simulation::WalkOptions options;
  options.seed = settings.simulation_seed;
  options.duration_s = settings.simulation_duration_s;
  OpenedFrames opened;
  opened.camera = make_camera(options.camera);
  opened.recorded = make_prefetching_source(make_simulated_source(options), kFramesAhead);
  return opened;
}

dataset::CameraCalibration calibration_of(const SourceSettings& settings) {
  if (settings.calibration.empty()) {
    throw ConfigurationFault(
        "vision.calibration: a live camera needs its calibration; give --calibration FILE");
  }
  return dataset::read_camera_calibration(settings.calibration);
}

OpenedFrames open_topic(const SourceSettings& settings, app::ServiceContext& context) {
  if (settings.publish_images) {
    throw ConfigurationFault(
        "vision.publish_images: the images come from that very topic; turn it off");
  }
  OpenedFrames opened;
  opened.camera = make_camera(calibration_of(settings));
  opened.live = std::make_unique<TopicFrames>(context);
  return opened;
}

OpenedFrames open_camera(const SourceSettings& settings) {
  const dataset::CameraCalibration calibration = calibration_of(settings);
  OpenedFrames opened;
  opened.camera = make_camera(calibration);
  LiveCameraOptions options;
  options.latency_s = settings.camera_latency_s - calibration.timeshift_s;
  options.clock = host_now_ns;
  opened.live = std::make_unique<LiveCamera>(
      make_camera_grabber(settings.camera, settings.camera_width_px, settings.camera_height_px),
      std::move(options));
  return opened;
}

}  // namespace

OpenedFrames open_frames(const SourceSettings& settings, app::ServiceContext& context) {
  const int chosen = (settings.recording.empty() ? 0 : 1) + (settings.simulate ? 1 : 0) +
                     (settings.camera.empty() ? 0 : 1) + (settings.from_topic ? 1 : 0);
  if (chosen != 1) {
    throw ConfigurationFault(
        "vision: " + std::string(chosen == 0 ? "no" : "more than one") +
        " source is chosen; give exactly one of --recording DIR, --simulate, --camera SOURCE, "
        "--from-topic");
  }
  if (!settings.recording.empty()) return open_recording(settings);
  if (settings.simulate) return open_simulation(settings);
  if (settings.from_topic) return open_topic(settings, context);
  return open_camera(settings);
}

}  // namespace vpdr::vision
