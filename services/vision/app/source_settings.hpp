#pragma once
// Settings of vision that say where its frames come from.
#include <cstdint>
#include <string>

#include "config/binder.hpp"

namespace vpdr::vision {

/// Bound as `vision.*`. Exactly one source is chosen: recording, simulation, topic or camera.
struct SourceSettings {
  std::string recording;  ///< folder, see docs/recordings.md
  bool simulate = false;
  std::uint64_t simulation_seed = 1;
  double simulation_duration_s = 120.0;
  bool from_topic = false;  ///< camera/image/compressed
  std::string camera;       ///< index, device or URL
  int camera_width_px = 0;
  int camera_height_px = 0;
  double camera_latency_s = 0.0;
  std::string calibration;      ///< file; empty: the recording's own
  std::string mount;            ///< axes as imu_gateway's; empty: what the recording says
  double video_offset_s = 0.0;  ///< of a video's first frame after the first inertial sample
  bool publish_images = false;
};

void bind(config::Binder& binder, SourceSettings& settings);

}  // namespace vpdr::vision
