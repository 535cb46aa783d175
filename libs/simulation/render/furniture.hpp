#pragma once
// Shelves, cabinets, tables, cartons and screens along the walls of a room.
#include <Eigen/Core>
#include <vector>

#include "simulation/floor_plan.hpp"
#include "simulation/random.hpp"
#include "simulation/render/solid.hpp"

namespace vpdr::simulation {

/// Draws furniture before a share of a room's walls; nothing stands within half a metre of `way`.
std::vector<Solid> draw_furniture(const Rectangle& room, const std::vector<Eigen::Vector2d>& way,
                                  double share, Random& random);

}  // namespace vpdr::simulation
