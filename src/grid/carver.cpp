#include "grid/carver.hpp"

#include <algorithm>
#include <bit>

#include "grid/carving.hpp"

namespace iog::grid {

using traversal::Position;
using vehicle::Sensor;

Carver::Carver(const vehicle::Vehicle& vehicle, BlockGrid& grid, PendingMarks& marks)
    : lines_(vehicle.sensors), vehicle_(&vehicle), grid_(&grid), marks_(&marks) {}

vehicle::Fate Carver::add(const Sensor& sensor, const lidar::ScanPoint& point) {
  const vehicle::Layer& layer = sensor.layers[point.layer];
  turn_to(sensor, point.azimuth_ticks);
  OpenLine& open = open_line(layer);
  const KeptLine& line = *open.line;
  KeptBeam& beam = beam_of(layer, point.layer);
  const vehicle::Classification classification =
      vehicle::classify(sensor, line.line(), beam.end_z(), point);
  const bool has_point = 0 < point.range_mm && point.range_mm <= sensor.range.mm();
  const Position hit = has_point ? line.through(sensor, point.range_mm) : Position{};
  if (classification.carves) {
    const LinePart part = part_to_carve(line, beam, point, classification.is_whole_in_band, hit);
    if (!part.is_empty()) {
      carve_later(open, part, point.range_mm);
    }
  }
  if (classification.marks) {
    marks_->mark(sensor, line, hit, point.range_mm);
  }
  return classification.fate;
}

void Carver::turn_to(const Sensor& sensor, std::uint16_t azimuth_ticks) {
  if (sensor_ == &sensor && azimuth_ticks_ == azimuth_ticks) {
    return;
  }
  carve_waiting();
  sensor_ = &sensor;
  azimuth_ticks_ = azimuth_ticks;
  direction_ = vehicle::direction_of(sensor, azimuth_ticks);
  kept_ = &lines_.azimuth(sensor, azimuth_ticks);
}

Carver::OpenLine& Carver::open_line(const vehicle::Layer& layer) {
  OpenLine& open = open_lines_[layer.line];
  const std::uint32_t bit = 1U << layer.line;
  if ((lines_in_use_ & bit) == 0) {
    lines_in_use_ |= bit;
    if (layer.line < KeptAzimuth::kMaxLines) {
      open.line = &kept_->line_of(*sensor_, layer, direction_);
    } else {
      open.line = &further_lines_[layer.line - KeptAzimuth::kMaxLines];
      open.line->find(*sensor_, layer, direction_);
    }
  }
  return open;
}

KeptBeam& Carver::beam_of(const vehicle::Layer& layer, std::uint8_t number) {
  const bool is_kept = number < KeptAzimuth::kMaxLayers && layer.line < KeptAzimuth::kMaxLines;
  KeptBeam& beam = is_kept ? kept_->beam_of(number) : further_beam_;
  if (!is_kept || !beam.is_found()) {
    beam.find(vehicle::end_height_of(layer, direction_));
  }
  return beam;
}

// The part of its line that a beam carves: up to its scan point, or the whole line if that is too
// far. A beam without an echo carves as far as the sensor's description says.
LinePart Carver::part_to_carve(const KeptLine& line, KeptBeam& beam, const lidar::ScanPoint& point,
                               bool is_whole_in_band, Position hit) const {
  LinePart part = line.in_grid();
  if (!is_whole_in_band) {
    if (beam.has_part()) {
      part = beam.part();
    } else {
      part = part_in_band(line, beam.end_z());
      beam.keep_part(part);
    }
  }
  const std::uint32_t length_mm = sensor_->range.mm();
  if (point.range_mm == 0) {
    if (sensor_->no_return_clears_mm < length_mm) {
      part.end_at({line.line().before({sensor_->no_return_clears_mm, length_mm}), true});
    }
  } else if (point.range_mm <= length_mm) {
    part.end_at({hit, false});
  }
  return part;
}

// The part of a line that is in the grid and, for a beam that ends where the line ends, inside the
// height band. A beam is straight: a shorter one leaves the band at the same place.
LinePart Carver::part_in_band(const KeptLine& line, std::int32_t end_z) const {
  const vehicle::BandPart band =
      vehicle::part_in_band(*vehicle_, *sensor_, {line.line(), end_z}, sensor_->range.mm());
  LinePart part = line.in_grid();
  if (band.is_empty) {
    part.end = {};
  } else if (!band.is_whole) {
    if (band.from.numerator > 0) {
      part.begin_at(line.line().through(band.from));
    }
    part.end_at({line.line().before(band.to), true});
  }
  return part;
}

// Where a beam waits to be carved. If it goes through the same cells as the first line up to its
// end, it waits with the beams of the first line.
Carver::OpenLine& Carver::place_to_wait(OpenLine& open, Between end) {
  OpenLine& first = open_lines_[0];
  const bool may_share =
      &open == &open_lines_[1] && (lines_in_use_ & 1U) != 0 && first.line->has_path();
  return may_share && kept_->is_common(end.at) ? first : open;
}

// Adds a beam to the steps of its line. A cell before the scan point * takes the index of the 1D
// cell in which the line leaves it, at most k - 1. For a LUX:
//
//    1D cells      k - 3   |   k - 2   |   k - 1   |     k     |
//    the line  S ----------+-----------+-----------+-------*---+-------> E
//    its cells     a   |   b    |  c  |    d    |   e   |    f     |
//    freer by      14      7       7       0        0     marked, not carved
//    steps     +14       -7 at b         -7 at d
//
// The line leaves a cell in 1D cell j or earlier exactly if it crosses the cell's far border at
// distance (j + 1) Delta or before. `through` counts those crossings. So the zone of 1D cell k - 2
// begins in the cell that holds the point at (k - 2) Delta, here b.
void Carver::carve_later(OpenLine& open, const LinePart& part, std::uint32_t range_mm) {
  const KeptLine& line = *open.line;
  const sensor_model::Profile& profile = sensor_->profile;
  OpenLine& waiting = place_to_wait(open, part.end);
  if (!waiting.steps.has_room()) {
    carve(waiting);
  }
  FreeSteps& steps = waiting.steps;
  if (part.first == line.in_grid().first) {
    steps.add_from_start(-profile.free);
  } else {
    steps.add({part.first, false}, -profile.free);
  }
  std::int32_t freer = -profile.free;
  if (range_mm > 0) {
    const std::uint32_t first = part.first.crossed();
    const std::uint32_t end = part.end.crossed();
    const std::uint32_t k = sensor_->precision.divide(range_mm);
    for (std::uint32_t back = profile.near_before_count; back > 0; --back) {
      // 1D cells from k - back on, which begin at (k - back) Delta.
      const Position zone =
          k < back ? part.first : line.through(*sensor_, (k - back) * sensor_->precision_mm);
      if (zone.crossed() >= end) {
        break;
      }
      const std::int32_t in_zone = -profile.near_before[back - 1];
      steps.add({zone.crossed() > first ? zone : part.first, false}, in_zone - freer);
      freer = in_zone;
    }
  }
  if (freer > 0) {
    steps.add(part.end, -freer);
  }
}

void Carver::carve_waiting() {
  for (; lines_in_use_ != 0; lines_in_use_ &= lines_in_use_ - 1) {
    carve(open_lines_[static_cast<std::size_t>(std::countr_zero(lines_in_use_))]);
  }
}

void Carver::carve(OpenLine& open) {
  if (open.steps.empty()) {
    return;
  }
  if (open.line->has_path()) {
    carve_blocks(*grid_, open.line->path(), open.steps);
  } else {
    carve_cells(*grid_, open.line->line(), open.line->in_grid().first, open.steps);
  }
  open.steps.clear();
}

void Carver::drop_waiting() {
  for (OpenLine& open : open_lines_) {
    open.steps.clear();
  }
  lines_in_use_ = 0;
}

}  // namespace iog::grid
