#include "simulation/walk_camera.hpp"

#include <utility>

namespace vpdr::simulation {

WalkCamera::WalkCamera(SimulatedWalk walk, const RenderOptions& options)
    : walk_(std::move(walk)),
      renderer_(walk_.plan, walk_.options.camera, walk_.options.seed, options) {}

cv::Mat WalkCamera::image(std::size_t frame) const {
  return renderer_.render(walk_.world_from_camera(stamp(frame)), frame);
}

}  // namespace vpdr::simulation
