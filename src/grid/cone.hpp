// Carves the cone of an ultrasonic unit up to its echo. All cells of the cone take the same index,
// below 0 (sensor_model/arc.hpp).
//
// Sound fills the cone, so each cell takes the index once per echo. Beams, in contrast, would cross
// the cells near the unit several times. A cell is carved if all of it lies between the outermost
// directions of the unit's arc and nearer than the 1D cells around the echo. Cells cut by the
// cone's border do not change. The order of indexes below 0 does not matter (docs/model.md, section
// 3), so cones are carved as they arrive.
//
// If the unit is tilted, the cone on the grid is as long as the shortest of three directions: the
// two outermost ones and the middle.
#pragma once

#include "grid/block_grid.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// The sensor must have an arc of at most 50 degrees to either side, and a range of at most 10 m.
void carve_cone(BlockGrid& grid, const vehicle::Sensor& sensor, const lidar::ScanPoint& echo);

// Upper bound on the cells tested for an echo at this range. The area is at most twice as long as
// wide.
[[nodiscard]] constexpr std::uint32_t most_cells_of_cone(std::uint32_t range_mm) {
  const std::uint32_t side = range_mm / geometry::kCellMm + 2;
  return side * 2 * side;
}

}  // namespace iog::grid
