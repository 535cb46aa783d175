#include "vision/app/source_settings.hpp"

namespace vpdr::vision {

void bind(config::Binder& binder, SourceSettings& s) {
  using config::above;
  using config::at_least;
  binder.text("recording", s.recording, "folder of the recorded walk whose images are looked at");
  binder.flag("simulation.enabled", s.simulate, "look at the images of a simulated walk");
  binder.integer("simulation.seed", s.simulation_seed, at_least(0), "", "seed of the walk");
  binder.number("simulation.duration_s", s.simulation_duration_s, above(0), "s", "its length");
  binder.flag("camera.from_topic", s.from_topic,
              "look at the images that another process publishes on camera/image/compressed");
  binder.text("camera.source", s.camera, "live camera: index, device or URL");
  binder.integer("camera.width_px", s.camera_width_px, at_least(0), "px",
                 "asked of the camera; 0: its own");
  binder.integer("camera.height_px", s.camera_height_px, at_least(0), "px",
                 "asked of the camera; 0: its own");
  binder.number("camera.latency_s", s.camera_latency_s, at_least(0), "s",
                "from exposure to arrival of a live frame");
  binder.text("calibration", s.calibration,
              "camera calibration (camchain.yaml, sensor.yaml, camera_info.yaml); empty: the "
              "recording's own");
  binder.text("mount.axes", s.mount,
              "sensor axes that point forward, left and up on the body, the same as "
              "imu_gateway.mount.axes; empty: what the recording says");
  binder.number("video.offset_s", s.video_offset_s, config::any(), "s",
                "of a video's first frame after the first inertial sample");
  binder.flag("publish_images", s.publish_images, "publish the frames on camera/image/compressed");
}

}  // namespace vpdr::vision
