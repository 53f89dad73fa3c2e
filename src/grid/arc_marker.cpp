#include "grid/arc_marker.hpp"

#include <algorithm>
#include <span>

#include "grid/cone.hpp"

namespace iog::grid {

vehicle::Fate ArcMarker::add(const vehicle::Sensor& sensor, const lidar::ScanPoint& point) {
  const vehicle::Beam beam = vehicle::aim(sensor, point.layer, point.azimuth_ticks);
  const vehicle::Classification classified = vehicle::classify(sensor, beam, point);
  if (classified.evidence.marks()) {
    mark_arc(sensor, point);
  }
  if (classified.evidence.is_whole_hit() && sensor.arc.free < 0) {
    carve_cone(grids_->indexes, sensor, point);
  }
  return classified.fate;
}

// Marks the points of the arc, one on the line of each step. Points on the car itself are skipped.
void ArcMarker::mark_arc(const vehicle::Sensor& sensor, const lidar::ScanPoint& point) {
  const auto turn = static_cast<std::int32_t>(sensor.azimuths.ticks_per_turn());
  const std::int32_t step = arc_step_ticks(sensor, point.range_mm);
  const std::int32_t last = sensor.arc.reach_ticks() / step * step;
  const vehicle::Layer& layer = sensor.layers[point.layer];
  for (std::int32_t off = -last; off <= last; off += step) {
    const std::int32_t azimuth = (point.azimuth_ticks + off + turn) % turn;
    const vehicle::BeamLine line = vehicle::line_of(
        sensor, layer, vehicle::direction_of(sensor, static_cast<std::uint32_t>(azimuth)));
    if (!vehicle::ranges_on_car(sensor, line).contain(point.range_mm)) {
      step_into(sensor, line.cell(line.through(point.range_mm, sensor.range)), sensor.arc.at(off));
    }
  }
  const std::size_t kept = std::min(entered_, kLately);
  for (std::size_t i = entered_ - kept; i < entered_; ++i) {
    marks_->mark(sensor, lately_[i % kLately].cell, lately_[i % kLately].index);
  }
  entered_ = 0;
}

void ArcMarker::step_into(const vehicle::Sensor& sensor, geometry::Cell cell,
                          OccupancyIndex index) {
  const auto known = std::span(lately_).first(std::min(entered_, kLately));
  const auto again = std::ranges::find(known, cell, &Step::cell);
  if (again != known.end()) {
    again->index = std::max(again->index, index);
    return;
  }
  Step& place = lately_[entered_ % kLately];
  if (entered_ >= kLately) {
    marks_->mark(sensor, place.cell, place.index);
  }
  place = {cell, index};
  ++entered_;
}

}  // namespace iog::grid
