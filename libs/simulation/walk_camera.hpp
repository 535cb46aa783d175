#pragma once
// The camera of a simulated walk. Two processes that simulate the same options see the same walk:
// one plays its samples, the other its pictures.
//
//   const WalkCamera camera(simulate_walk(options));
//   for (std::size_t k = 0; k < camera.count(); ++k) use(camera.stamp(k), camera.image(k));
#include <cstddef>
#include <memory>

#include "simulation/render/film.hpp"
#include "simulation/walk.hpp"

namespace vpdr::simulation {

/// What the camera of a walk films; it shares the walk.
Shot shot_of(std::shared_ptr<const SimulatedWalk> walk);

class WalkCamera {
 public:
  explicit WalkCamera(SimulatedWalk walk, const FilmOptions& options = {});

  [[nodiscard]] const SimulatedWalk& walk() const { return *walk_; }
  [[nodiscard]] const Film& film() const { return film_; }
  [[nodiscard]] std::size_t count() const { return film_.count(); }
  [[nodiscard]] TimestampNs stamp(std::size_t frame) const { return film_.stamp(frame); }
  [[nodiscard]] cv::Mat image(std::size_t frame) const { return film_.image(frame); }

 private:
  std::shared_ptr<const SimulatedWalk> walk_;
  Film film_;
};

}  // namespace vpdr::simulation
