// The marks of a radar: a detection has a direction that is known to half a degree or so, and marks
// the cells of an arc (sensor_model/arc.hpp). It carves nothing. An ultrasonic unit's is as wide as
// its cone, which it carves (grid/cone.hpp).
//
// A cell of the arc takes the index of the angular cell in which it lies. The arc is followed from
// right to left in steps of whole ticks, each at most a cell long at the detection's range, so that
// it has no gaps; of the steps that end in one cell the largest index counts, once. So near the
// sensor, where an angular cell is narrower than a cell of the grid, a detection marks one cell
// with the index of its middle, and far away all that it may have come from.
//
// Marks commute, so the order of detections does not show. How many steps a detection has at most
// is known beforehand (most_arc_steps()).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/cell.hpp"
#include "grid/frame_grids.hpp"
#include "grid/pending_marks.hpp"
#include "index/occupancy_index.hpp"
#include "lidar/scan_point.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

class ArcMarker {
 public:
  // Both outlive it.
  ArcMarker(FrameGrids& grids, PendingMarks& marks) : grids_(&grids), marks_(&marks) {}

  // Remembers what this detection marks, and carves its cone if it has one. The sensor has an arc;
  // the point's layer and azimuth are those of its format. The detection is judged by the height
  // band of the vehicle.
  vehicle::Fate add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point);

 private:
  void mark_arc(const vehicle::Sensor& sensor, const lidar::ScanPoint& point);
  void step_into(geometry::Cell cell, OccupancyIndex index);

  // An arc that leaves a cell and comes back is outside for less than the cell's diagonal. On a
  // level sensor that is three steps, as one is at least half a cell long, and on one that is
  // tilted by 60 degrees six; each of them is in another cell at most.
  static constexpr std::size_t kLately = 8;
  struct Step {
    geometry::Cell cell;
    OccupancyIndex index = 0;
  };

  FrameGrids* grids_;
  PendingMarks* marks_;
  // Of the arc at hand, a ring: the cells that were entered last, which are marked when they leave.
  std::array<Step, kLately> lately_{};
  std::size_t entered_ = 0;
};

}  // namespace iog::grid
