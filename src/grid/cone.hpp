// Carves the cone of an ultrasonic unit up to its echo. All cells of the cone get the same negative
// index (sensor_model/arc.hpp).
//
// Because sound fills the cone, an echo adds the index to each cell of the cone exactly once. If
// the cone were filled with beams, several of them would cross the same cells near the unit. A cell
// is carved if the whole cell lies within the unit's arc and is nearer to the unit than the 1D
// cells around the echo. Cells on the border of the cone do not change. Negative indexes can be
// added in any order (docs/model.md, section 3), so each cone is carved as soon as its echo
// arrives.
//
// If the unit is tilted, the cone's two outermost directions and its middle direction have
// different lengths on the grid. The length of the carved cone is the shortest of these lengths.
#pragma once

#include "grid/block_grid.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// The sensor must have an arc of at most 50 degrees to each side, and a range of at most 10 m.
void carve_cone(BlockGrid& grid, const vehicle::Sensor& sensor, const lidar::ScanPoint& echo);

// Returns an upper bound on the number of cells that are tested for an echo at this range. The
// tested area is at most twice as long as it is wide.
[[nodiscard]] constexpr std::uint32_t most_cells_of_cone(const geometry::Grid& grid,
                                                         std::uint32_t range_mm) {
  const std::uint32_t side = range_mm / grid.cell_mm + 2;
  return side * 2 * side;
}

}  // namespace iog::grid
