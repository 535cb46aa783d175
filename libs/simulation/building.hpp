#pragma once
// An office building drawn from a seed: on each storey corridors on a grid of lines with some of
// them left out, stairs between the storeys, and walks through it that turn often and come back to
// where they began. World ENU, metres.
#include <Eigen/Core>
#include <vector>

#include "simulation/floor_plan.hpp"
#include "simulation/random.hpp"
#include "simulation/stairs.hpp"

namespace vpdr::simulation {

/// Building sizes. Every coordinate comes out as a multiple of the ceiling tile.
struct BuildingOptions {
  int north_south_corridors = 5;
  int east_west_corridors = 4;
  double min_block_m = 9.0;  ///< between the centre lines of neighbouring corridors
  double max_block_m = 13.8;
  double min_width_m = 2.1;  ///< of a corridor
  double max_width_m = 2.8;
  double ceiling_m = 2.7;
  double left_out_share = 0.18;  ///< of the corridor pieces between two crossings
  int storeys = 1;  ///< each to the east of the one below it, a flight of stairs between
};

/// The size of the ceiling and floor tiles, metres.
inline constexpr double kTileM = 0.6;

/// A corridor network: crossings and the pieces of corridor between them.
struct CorridorNetwork {
  std::vector<Eigen::Vector2d> crossings_m;
  std::vector<std::vector<int>> neighbours;  ///< of each crossing
  std::vector<double> floor_m;               ///< of each crossing
};

struct Building {
  CorridorNetwork network;
  std::vector<Rectangle> corridors;  ///< and treads of stairs
  std::vector<Flight> flights;       ///< from the lowest storey up
};

/// Draws a building: all crossings connected, no dead end. Throws ConfigurationFault for sizes that
/// make no building.
Building draw_building(const BuildingOptions& options, Random& random);

/// A walk as corners, first and last point included.
struct Route {
  std::vector<Eigen::Vector2d> corners_m;
  double length_m = 0.0;
  int turns = 0;
  int flights = 0;       ///< of stairs, up or down
  double floor_m = 0.0;  ///< where it starts
  bool closed = false;   ///< ends where and as it began
};

/// A random walk of at most `length_m` that starts in the middle of a corridor, never turns back,
/// and ends where it began if it comes by there near its end.
Route draw_route(const CorridorNetwork& network, double length_m, Random& random);

/// Straight corridors around the legs of a given route; one hall around all of it where a leg runs
/// along neither axis.
std::vector<Rectangle> corridors_around(const std::vector<Eigen::Vector2d>& corners_m,
                                        double width_m);

}  // namespace vpdr::simulation
