#pragma once
// What pictures are made from: where they are taken, with which camera, along which path.
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/time.hpp"
#include "simulation/camera.hpp"
#include "simulation/floor_plan.hpp"
#include "simulation/render/solid.hpp"

namespace vpdr::simulation {

struct Shot {
  FloorPlan plan;
  std::vector<Solid> furniture{};
  Camera camera;
  std::uint64_t seed = 1;
  std::vector<TimestampNs> frames;  ///< stamps of the pictures: the middle of each exposure
  /// True pose of the camera at an instant; clamped outside the path.
  std::function<Eigen::Isometry3d(TimestampNs)> world_from_camera;
};

}  // namespace vpdr::simulation
