#include "vision/source/recorded_frames.hpp"

#include <utility>
#include <vector>

#include "vision/source/make_camera.hpp"
#include "vision/source/prefetching_source.hpp"

namespace vpdr::vision {
namespace {
constexpr std::size_t kFramesAhead = 3;
}

RecordedFrames open_recorded_frames(const dataset::Recording& recording, double video_offset_s) {
  RecordedFrames opened;
  if (recording.images.empty() && !recording.video) {
    opened.idle_reason = "the recording has no images";
    return opened;
  }
  if (!recording.camera) {
    opened.idle_reason = "the camera of the recording is not calibrated";
    opened.idle_remedy = "give --calibration FILE, or put camchain.yaml into the recording";
    return opened;
  }
  opened.camera = make_camera(*recording.camera);
  const TimestampNs shift = to_ns(recording.camera->timeshift_s);
  std::unique_ptr<FrameSource> source;
  if (recording.images.empty()) {
    const TimestampNs first = recording.imu.empty() ? 0 : recording.imu.front().stamp_ns;
    source = make_video_source(*recording.video, first + to_ns(video_offset_s) + shift);
  } else {
    std::vector<dataset::ImageEntry> images = recording.images;
    for (dataset::ImageEntry& image : images) image.stamp_ns += shift;
    source = make_image_list_source(std::move(images));
  }
  opened.source = make_prefetching_source(std::move(source), kFramesAhead);
  return opened;
}

}  // namespace vpdr::vision
