#pragma once
// The pictures of a simulated walk, made when they are asked for. Two processes that simulate the
// same options see the same walk: one plays its samples, the other its pictures.
//
//   const WalkCamera camera(simulate_walk(options));
//   for (std::size_t k = 0; k < camera.count(); ++k) use(camera.stamp(k), camera.image(k));
#include <cstddef>
#include <cstdint>

#include "simulation/corridor_renderer.hpp"
#include "simulation/walk.hpp"

namespace vpdr::simulation {

/// image() may be called from several threads.
class WalkCamera {
 public:
  explicit WalkCamera(SimulatedWalk walk, const RenderOptions& options = {});

  [[nodiscard]] const SimulatedWalk& walk() const { return walk_; }
  [[nodiscard]] std::size_t count() const { return walk_.frames.size(); }
  [[nodiscard]] TimestampNs stamp(std::size_t frame) const { return walk_.frames.at(frame); }
  /// Picture number `frame`, CV_8UC1; always the same one. Throws std::out_of_range.
  [[nodiscard]] cv::Mat image(std::size_t frame) const;

 private:
  SimulatedWalk walk_;
  CorridorRenderer renderer_;
};

}  // namespace vpdr::simulation
