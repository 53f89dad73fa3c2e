// Why the costs bound. A point costs p, a cell c. The short beams have the most points and hardly a
// cell, so their cost per point is at least p for points that are fused the usual way. c is what a
// frame of long beams costs beyond that, by its cells; where a point costs more than p, because the
// height band or the edge of the grid cuts its beam, the rest is charged to the cells of a beam
// that is shorter than the longest, so that p + c * (cells of the longest) is still above it.
#include "lab/experiments/frame_bound.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/grid.hpp"
#include "lab/experiments/a9_frame.hpp"
#include "lab/scenarios/worst_frames.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::lab {
namespace {

// Borders that a line of this length crosses: its extents along both axes add up to sqrt(2) of it
// at most, and each may cross one more than whole cells fit into it. It enters a cell with each,
// and was in one before.
double most_cells(double length_mm) {
  return std::floor(std::numbers::sqrt2 * length_mm / geometry::kCellMm) + 2 + 1;
}

FrameBound counts_of(const vehicle::Vehicle& car) {
  FrameBound bound;
  for (const vehicle::Sensor& sensor : car.sensors) {
    const double points = sensor.max_points_per_scan;
    const double cells = most_cells(sensor.range.mm());
    bound.points += points;
    bound.cells += points * cells;
    bound.cells_per_beam = std::max(bound.cells_per_beam, cells);
  }
  bound.tiles = geometry::kTileCount;
  return bound;
}

}  // namespace

FrameBound frame_bound() {
  FrameBound bound = counts_of(*tools::find_vehicle(tools::kDefaultVehicle).vehicle);
  const A9Frame short_beams = a9_worst_frame("short_beams");
  bound.per_point = short_beams.fuse / short_beams.points;
  bound.per_mark = short_beams.mark / short_beams.points;
  double most_tiles = 0;
  for (const WorstFrame& worst : all_worst_frames()) {
    const A9Frame cost = a9_worst_frame(worst.name);
    bound.receive = std::max(bound.receive, cost.receive);
    if (cost.tiles > most_tiles) {
      most_tiles = cost.tiles;
      bound.per_tile = cost.publish / cost.tiles;
    }
    if (worst.name != "short_beams") {
      const double of_cells = cost.fuse - cost.points * bound.per_point;
      bound.per_cell = std::max(bound.per_cell, of_cells / cost.cells);
    }
  }
  return bound;
}

}  // namespace iog::lab
