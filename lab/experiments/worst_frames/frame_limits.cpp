#include "lab/experiments/worst_frames/frame_limits.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/grid.hpp"

namespace iog::lab {
namespace {

// Borders that a line of this length crosses: its extents along both axes add up to sqrt(2) of it
// at most, and each may cross one more than whole cells fit into it. It enters a cell with each,
// and was in one before.
double most_cells(double length_mm, double cell_mm) {
  return std::floor(std::numbers::sqrt2 * length_mm / cell_mm) + 2 + 1;
}

}  // namespace

FrameLimits frame_limits(const vehicle::Vehicle& vehicle) {
  FrameLimits limits;
  for (const vehicle::Sensor& sensor : vehicle.sensors) {
    const double points = sensor.max_points_per_scan;
    const double cells = most_cells(sensor.range.mm(), vehicle.grid.cell_mm);
    limits.points += points;
    limits.range_m = std::max(limits.range_m, sensor.range.mm() / 1000.0);
    limits.cells_per_beam = std::max(limits.cells_per_beam, cells);
    limits.cells += points * cells;
  }
  limits.tiles = geometry::kTileCount;
  return limits;
}

}  // namespace iog::lab
