#pragma once
// How a track lies to the surveyed waypoints of its walk; at least two of them. Metres.
#include <vector>

#include "dataset/recording.hpp"
#include "evaluation/run_directory.hpp"

namespace vpdr::bench {

/// How honest the covariance is at the waypoints after the first.
struct Honesty {
  double nees = 0.0;            ///< mean of e' P^-1 e / 2: 1 where honest
  double inside_percent = 0.0;  ///< in the 95 % ellipse
};

Honesty honesty_of(const evaluation::RunDirectory& run,
                   const std::vector<dataset::Waypoint>& waypoints);

/// Mean distance from the waypoints after the best turn about the first, and the best scale too.
struct Fitted {
  double turned_m = 0.0;
  double scaled_m = 0.0;
  double turn_deg = 0.0;  ///< of that turn, counter-clockwise
};

Fitted fitted_to_waypoints(const evaluation::RunDirectory& run,
                           const std::vector<dataset::Waypoint>& waypoints);

}  // namespace vpdr::bench
