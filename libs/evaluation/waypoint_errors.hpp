#pragma once
// Distance from surveyed waypoints: the estimate is moved so that it stands on the first waypoint
// at that waypoint's stamp, and is not rotated.
#include <optional>
#include <vector>

#include "dataset/recording.hpp"
#include "evaluation/run_directory.hpp"

namespace vpdr::evaluation {

struct WaypointErrors {
  double mean_m = 0.0;  ///< over the waypoints after the first
  double max_m = 0.0;
  double final_m = 0.0;        ///< at the last waypoint
  double final_percent = 0.0;  ///< of the length of the path through the waypoints
  double path_m = 0.0;
  std::vector<double> each_m;  ///< one for each waypoint, the first is 0
};

/// Compares horizontal positions, linear between the fused poses. nullopt with fewer than two
/// waypoints or without an estimate.
std::optional<WaypointErrors> waypoint_errors(const std::vector<StampedPose>& estimate,
                                              const std::vector<dataset::Waypoint>& waypoints);

}  // namespace vpdr::evaluation
