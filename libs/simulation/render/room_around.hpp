#pragma once
// A place in which a given path can have happened: a furnished room around a path that stays within
// a few metres, corridors along one that goes farther, a high hall where it climbs. World ENU,
// metres; walls run along the world's axes, or along the directions in which most of a long path
// goes.
#include <cstdint>
#include <vector>

#include "simulation/floor_plan.hpp"
#include "simulation/reference_path.hpp"
#include "simulation/render/shot.hpp"
#include "simulation/render/solid.hpp"

namespace vpdr::simulation {

struct RoomOptions {
  std::uint64_t seed = 1;
  double margin_m = 1.5;         ///< from the path to the walls of a room
  double largest_room_m = 15.0;  ///< a path that goes farther goes along corridors
  double ceiling_m = 2.7;        ///< at least
  double furniture_share = 0.6;  ///< of a room's walls that have furniture before them
};

/// The place in axes of its own, from which the world is turned about the vertical.
struct Surroundings {
  FloorPlan plan;
  std::vector<Solid> furniture;
  double yaw_rad = 0.0;  ///< of the place's x axis in the world

  /// Place from world.
  [[nodiscard]] Eigen::Isometry3d from_world() const;
};

/// The floor lies at z = 0 where that is a person's height or less below the whole path, else 1.3 m
/// below its lowest point. Nothing stands where the path goes.
Surroundings surround(const ReferencePath& path, const RoomOptions& options);

/// What a camera on the path's body films there. The poses of the shot are in the axes of the
/// place.
Shot shot_in(const Surroundings& place, const ReferencePath& path, const Camera& camera,
             std::uint64_t seed, std::vector<TimestampNs> frames);

}  // namespace vpdr::simulation
