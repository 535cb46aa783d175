#include "simulation/walk_camera.hpp"

#include <utility>

namespace vpdr::simulation {

Shot shot_of(std::shared_ptr<const SimulatedWalk> walk) {
  Shot shot{.plan = walk->plan,
            .camera = walk->options.camera,
            .seed = walk->options.seed,
            .frames = walk->frames,
            .world_from_camera = {}};
  shot.world_from_camera = [walk = std::move(walk)](TimestampNs stamp) {
    return walk->world_from_camera(stamp);
  };
  return shot;
}

WalkCamera::WalkCamera(SimulatedWalk walk, const FilmOptions& options)
    : walk_(std::make_shared<const SimulatedWalk>(std::move(walk))),
      film_(shot_of(walk_), options) {}

}  // namespace vpdr::simulation
