#pragma once
// From settings to the source of frames and the camera that took them.
#include <memory>
#include <optional>
#include <string>

#include "app/service.hpp"
#include "vision/app/source_settings.hpp"
#include "vision/core/camera_model.hpp"
#include "vision/source/frame_source.hpp"
#include "vision/source/live_frames.hpp"

namespace vpdr::vision {

/// What was opened. Without a camera model there is nothing to look at: `idle_reason` says why, and
/// `idle_remedy` what to do about it (empty where nothing is wrong).
struct OpenedFrames {
  std::optional<CameraModel> camera;
  std::unique_ptr<FrameSource> recorded;
  std::unique_ptr<LiveFrames> live;
  std::string idle_reason;
  std::string idle_remedy;
};

/// `context` gives the topic of images where that is the source. Throws ConfigurationFault where
/// not exactly one source is chosen, live frames have no calibration, they would be published on
/// the topic they come from, or the mount is wrong, and FileFault for a recording or calibration
/// that cannot be used.
OpenedFrames open_frames(const SourceSettings& settings, app::ServiceContext& context);

}  // namespace vpdr::vision
