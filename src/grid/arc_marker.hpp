// Marks the cells in which radars and ultrasonic units detect obstacles. The direction of a radar
// detection is known to about half a degree. A radar detection therefore marks the cells of an arc
// (sensor_model/arc.hpp) and carves no cells. The arc of an ultrasonic unit is as wide as its cone,
// and an echo carves the cone (grid/cone.hpp).
//
// Each cell of the arc gets the index of its angular cell. The marker traverses the arc from right
// to left in whole ticks. At the detection's range, each step is at most one cell long, so the arc
// has no gaps. If several steps end in one cell, the cell is marked only once, with the largest
// index. Near the sensor, an angular cell is narrower than a grid cell, so a detection marks a
// single cell with the index of the arc's middle. Far from the sensor, a detection marks every cell
// in which the reflector may be.
//
// Marks can be applied in any order, so the result does not depend on the order of the detections.
// One detection marks at most max_marks_per_point() cells.
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
  // Both arguments must outlive the marker.
  ArcMarker(FrameGrids& grids, PendingMarks& marks) : grids_(&grids), marks_(&marks) {}

  // Stores the marks of this detection. Also carves the cone if the sensor has one. The sensor must
  // have an arc. The point's layer and azimuth must be valid in the sensor's format. The detection
  // is an obstacle if it lies within the vehicle's height band.
  vehicle::Fate add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point);

 private:
  void mark_arc(const vehicle::Sensor& sensor, const lidar::ScanPoint& point);
  void step_into(const vehicle::Sensor& sensor, geometry::Cell cell, OccupancyIndex index);

  // An arc may leave a cell and enter it again. The part of the arc outside the cell is shorter
  // than the cell's diagonal. For a level sensor, whose steps are at least half a cell long, this
  // part has at most three steps. For a sensor tilted by 60 degrees, this part has at most six
  // steps. Each step enters at most one other cell.
  static constexpr std::size_t kLately = 8;
  struct Step {
    geometry::Cell cell;
    OccupancyIndex index = 0;
  };

  FrameGrids* grids_;
  PendingMarks* marks_;
  // A ring buffer of the cells that the current arc entered most recently. A cell is marked when it
  // leaves the ring buffer.
  std::array<Step, kLately> lately_{};
  std::size_t entered_ = 0;
};

}  // namespace iog::grid
