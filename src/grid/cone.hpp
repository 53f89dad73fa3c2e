// The cone of an ultrasonic unit before what it has heard: each of its cells takes one and the same
// index, below 0 (sensor_model/arc.hpp).
//
// A sound fills its cone, so a cell takes the index once for an echo, near the unit too, where
// beams would go through it one after another. Its cells are those that lie in it whole: between
// the outermost directions of the unit's arc, and nearer than the 1D cells around the echo. What
// is cut by its border stays as it is. Cells take an index below 0 in any order (docs/model.md,
// section 3), so cones are carved as they come.
//
// Where the unit is tilted, the cone on the grid is as long as the shortest of its outermost
// directions and its middle.
#pragma once

#include "grid/block_grid.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// The sensor has an arc of at most 50 degrees to either side, and a range of at most 10 m.
void carve_cone(BlockGrid& grid, const vehicle::Sensor& sensor, const lidar::ScanPoint& echo);

// How many cells are looked at for an echo so far away, at most: twice as long as wide.
[[nodiscard]] constexpr std::uint32_t most_cells_of_cone(std::uint32_t range_mm) {
  const std::uint32_t side = range_mm / geometry::kCellMm + 2;
  return side * 2 * side;
}

}  // namespace iog::grid
