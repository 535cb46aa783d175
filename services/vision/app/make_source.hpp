#pragma once
// From settings to the source of frames and the camera that took them.
#include <memory>
#include <optional>
#include <string>

#include "vision/app/source_settings.hpp"
#include "vision/core/camera_model.hpp"
#include "vision/source/frame_source.hpp"
#include "vision/source/live_camera.hpp"

namespace vpdr::vision {

/// What was opened. Without a camera model there is nothing to look at: `idle_reason` says why, and
/// `idle_remedy` what to do about it (empty where nothing is wrong).
struct OpenedFrames {
  std::optional<CameraModel> camera;
  std::unique_ptr<FrameSource> recorded;
  std::unique_ptr<LiveCamera> live;
  std::string idle_reason;
  std::string idle_remedy;
};

/// Throws ConfigurationFault where not exactly one source is chosen, a live camera has no
/// calibration or the mount is wrong, and FileFault for a recording or calibration that cannot be
/// used.
OpenedFrames open_frames(const SourceSettings& settings);

}  // namespace vpdr::vision
