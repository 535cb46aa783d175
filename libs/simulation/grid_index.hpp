#pragma once
// Cells of a grid stored row by row.
#include <cstddef>

namespace vpdr::simulation {

/// Place of a cell in storage; none of the three negative.
constexpr std::size_t grid_index(int column, int row, int columns) {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
         static_cast<std::size_t>(column);
}

}  // namespace vpdr::simulation
