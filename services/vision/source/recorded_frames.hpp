#pragma once
// The frames of a recording: its images, or else its video, decoded ahead in a thread of their own.
#include <memory>
#include <string>

#include "dataset/recording.hpp"
#include "vision/core/camera_model.hpp"
#include "vision/source/frame_source.hpp"

namespace vpdr::vision {

/// Without a camera there is nothing to look at: `idle_reason` says why, and `idle_remedy` what to
/// do about it (empty where nothing is wrong).
struct RecordedFrames {
  std::optional<CameraModel> camera;
  std::unique_ptr<FrameSource> source;
  std::string idle_reason;
  std::string idle_remedy;
};

/// `recording` is in body axes (apply_mount); frames get IMU time, by the calibration's shift of
/// the camera's clock; the first frame of a video was taken `video_offset_s` after the first
/// inertial sample. Throws FileFault for a video or calibration that cannot be used.
RecordedFrames open_recorded_frames(const dataset::Recording& recording, double video_offset_s);

}  // namespace vpdr::vision
