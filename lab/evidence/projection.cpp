// Either sampling comes down to the same three things, which is why one loop does for both: a path
// of cells; a reading of each cell that grows along the beam; and the readings at which each step
// of the local 1D grid ends. Positions and readings are linear in the cell's column and row, and
// all of them are exact integers.
//
// Ranges, with |S|, |E| < 2^21 subcells, L < 2^18 mm and scan points nearer than 2^20 mm: the
// largest reading is that of a cell's centre, 2^22 * 2^21 * L < 2^61, and the largest end of a step
// 2 * 2^20 mm * |E - S|^2 < 2^62 (beams of 130 m are 2^20.4 subcells long).

#include "lab/evidence/projection.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "fusion/frame_fusion.hpp"
#include "traversal/walk.hpp"
#include "vehicle/beam.hpp"

namespace iog::lab {
namespace {

using geometry::Cell;
using traversal::Position;
using traversal::Share;
using vehicle::BeamLine;
using vehicle::Sensor;

constexpr Share kWholeLine{1, 1};
constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

// A number that does not fall along a beam.
struct Reading {
  std::int64_t base = 0;
  std::int64_t per_column = 0;
  std::int64_t per_row = 0;

  [[nodiscard]] std::int64_t of(std::int64_t column, std::int64_t row) const {
    return base + column * per_column + row * per_row;
  }
};

// What one point says of the cells on its path.
struct Plan {
  Reading place;              // how many borders are crossed to a cell: 0, 1, ...
  std::int64_t path_end = 0;  // the path's last place and one more
  std::int64_t carve_first = 0;
  std::int64_t carve_end = 0;
  bool marks = false;
  Reading reading;
  std::array<std::int64_t, kStepCount>
      step_end{};  // by slot_of(step): readings below are that step
};

// The place that this share of the line lies in.
std::int64_t place_at(const BeamLine& line, Share share) { return line.through(share).crossed(); }
// One more than the place before this share: what is entered before it.
std::int64_t end_before(const BeamLine& line, Share share) {
  return std::int64_t{line.before(share).crossed()} + 1;
}

Reading place_reading(const BeamLine& line) {
  const std::int64_t x = line.x().step();
  const std::int64_t y = line.y().step();
  return {.base = -line.x().start_cell() * x - line.y().start_cell() * y,
          .per_column = x,
          .per_row = y};
}

// Where a cell's centre projects to on the line, in units of 1 mm / (2 |E - S|^2).
Reading centre_reading(const Sensor& sensor, const BeamLine& line) {
  constexpr std::int64_t kSide = geometry::kResolution;
  const std::int64_t length_mm = sensor.range.mm();
  const std::int64_t x = line.x().step() * std::int64_t{line.x().length()};
  const std::int64_t y = line.y().step() * std::int64_t{line.y().length()};
  return {.base = length_mm * ((kSide - 2 * std::int64_t{sensor.origin.x}) * x +
                               (kSide - 2 * std::int64_t{sensor.origin.y}) * y),
          .per_column = length_mm * 2 * kSide * x,
          .per_row = length_mm * 2 * kSide * y};
}

// 1D cells up to and including k + step, counted from the sensor; may be negative.
std::int64_t cells_to(std::uint32_t k, int step) { return std::int64_t{k} + step + 1; }

// Where the last of so many 1D cells ends.
Share end_of(const Sensor& sensor, std::int64_t cells) {
  return {static_cast<std::uint64_t>(cells) * sensor.precision_mm, sensor.range.mm()};
}

void read_centres(const Sensor& sensor, const BeamLine& line, std::uint32_t k, Plan& plan) {
  plan.reading = centre_reading(sensor, line);
  const std::int64_t x = line.x().length();
  const std::int64_t y = line.y().length();
  for (int step = -kFarSteps; step <= kFarSteps; ++step) {
    plan.step_end[slot_of(step)] = cells_to(k, step) * sensor.precision_mm * 2 * (x * x + y * y);
  }
}

// A place is entered within 1D cell j or earlier exactly if it is entered before (j + 1) Delta.
void read_entries(const Sensor& sensor, const BeamLine& line, std::uint32_t k, Plan& plan) {
  plan.reading = plan.place;
  for (int step = -kFarSteps; step <= kFarSteps; ++step) {
    const std::int64_t cells = cells_to(k, step);
    plan.step_end[slot_of(step)] = cells <= 0 ? 0 : end_before(line, end_of(sensor, cells));
  }
}

// It is left within 1D cell j or earlier exactly if the border there is crossed at (j + 1) Delta or
// before. Beyond the range there is no scan point to end the steps before it.
void read_as_model(const Sensor& sensor, const BeamLine& line, std::uint32_t range_mm,
                   std::uint32_t k, Plan& plan) {
  read_entries(sensor, line, k, plan);
  for (int step = -kFarSteps; step < -1; ++step) {
    const std::int64_t cells = cells_to(k, step);
    plan.step_end[slot_of(step)] = cells < 0 ? 0 : place_at(line, end_of(sensor, cells));
  }
  const bool in_range = range_mm <= sensor.range.mm();
  const std::int64_t hit = in_range ? place_at(line, {range_mm, sensor.range.mm()}) : kNever - 1;
  plan.step_end[slot_of(-1)] = hit;
  plan.step_end[slot_of(0)] = hit + 1;
}

// The places that a beam may carve: up to its reach, inside the height band.
void limit_carving(const vehicle::Vehicle& vehicle, const Sensor& sensor, const vehicle::Beam& beam,
                   std::uint32_t reach_mm, Plan& plan) {
  const vehicle::BandPart part =
      vehicle::part_in_band(vehicle.band(), sensor, beam.end_z, reach_mm);
  plan.carve_end = part.is_empty ? 0 : plan.path_end;
  if (!part.is_whole && !part.is_empty) {
    plan.carve_first = part.from.numerator > 0 ? place_at(beam.line, part.from) : 0;
    plan.carve_end = std::min(plan.carve_end, end_before(beam.line, part.to));
  }
}

// No step of a scan point here lies further behind it than this.
std::uint64_t far_mm(const Sensor& sensor, std::uint32_t range_mm) {
  return range_mm + std::uint64_t{kFarSteps + 2} * sensor.precision_mm +
         std::uint64_t{2} * geometry::kCellMm;
}

Plan plan_of_point(const Sensor& sensor, const BeamLine& line, std::uint32_t range_mm,
                   Sampling sampling) {
  const std::uint32_t length_mm = sensor.range.mm();
  const std::uint32_t k = sensor.precision.divide(range_mm);
  Plan plan;
  plan.place = place_reading(line);
  plan.path_end = end_before(line, kWholeLine);
  if (far_mm(sensor, range_mm) < length_mm) {
    plan.path_end = end_before(line, {far_mm(sensor, range_mm), length_mm});
  }
  if (sampling == Sampling::kModel) {
    read_as_model(sensor, line, range_mm, k, plan);
  } else {
    read_centres(sensor, line, k, plan);
  }
  return plan;
}

// A missing return that clears: as far before a scan point as can be, all the way.
Plan plan_of_missing_return(const Sensor& sensor, const BeamLine& line, std::uint32_t clears_mm) {
  Plan plan;
  plan.place = place_reading(line);
  plan.path_end = end_before(line, {clears_mm, sensor.range.mm()});
  plan.step_end.fill(kNever);
  return plan;
}

// The path's cells that lie in the grid, in order, as offsets.
using Cells = std::vector<std::uint32_t>;

void walk(const BeamLine& line, std::int64_t path_end, Cells& path) {
  const auto inside = line.clip(geometry::kGridArea);
  if (!inside) {
    return;
  }
  const auto end = static_cast<std::uint32_t>(
      std::min<std::int64_t>(path_end, std::int64_t{inside->last.crossed()} + 1));
  traversal::Walk cells(line, inside->first, geometry::kCellsPerSide);
  cells.until(end, [&](std::size_t offset) { path.push_back(static_cast<std::uint32_t>(offset)); });
}

// Readings do not fall along a path, so that no step is looked for twice.
void read_path(const Cells& path, const Plan& plan, std::vector<CellEvidence>& evidence) {
  std::size_t slot = 0;
  for (const std::uint32_t offset : path) {
    const std::int64_t column = offset % geometry::kCellsPerSide;
    const std::int64_t row = offset / geometry::kCellsPerSide;
    const std::int64_t reading = plan.reading.of(column, row);
    while (slot < kStepCount && reading >= plan.step_end[slot]) {
      ++slot;
    }
    if (slot == kStepCount) {
      return;
    }
    const int step = static_cast<int>(slot) - kFarSteps;
    const std::int64_t place = plan.place.of(column, row);
    const bool carves = plan.carve_first <= place && place < plan.carve_end;
    if (step < 0 ? carves : plan.marks) {
      evidence.push_back({offset, static_cast<std::int8_t>(step)});
    }
  }
}

class Projector {
  static constexpr std::size_t kCellsPerPoint = 256;  // more than most frames need

 public:
  Projector(const vehicle::Vehicle& vehicle, Sampling sampling, std::size_t points)
      : vehicle_(&vehicle), sampling_(sampling) {
    evidence_.cells.reserve(points * kCellsPerPoint);
  }

  void add(const SensorPoint& seen) {
    const Sensor& sensor = vehicle_->sensors[seen.sensor];
    const lidar::ScanPoint& point = seen.point;
    const vehicle::Beam beam = vehicle::aim(sensor, point.layer, point.azimuth_ticks);
    const vehicle::Classification classification = vehicle::classify(sensor, beam, point);
    if (!classification.evidence.is_any()) {
      return;
    }
    const bool is_missing = point.range_mm == 0;
    const std::uint32_t along_mm = sensor.layers[point.layer].along_line_mm(
        is_missing ? sensor.no_return_clears_mm : point.range_mm);
    Plan plan = is_missing ? plan_of_missing_return(sensor, beam.line, along_mm)
                           : plan_of_point(sensor, beam.line, along_mm, sampling_);
    if (classification.evidence.carves()) {
      limit_carving(*vehicle_, sensor, beam, std::min(along_mm, sensor.range.mm()), plan);
    }
    if (classification.evidence.marks()) {
      plan.marks = true;
      remember_hit(sensor, beam.line, along_mm, plan);
    }
    path_.clear();
    walk(beam.line, plan.path_end, path_);
    read_path(path_, plan, evidence_.cells);
  }

  [[nodiscard]] FrameEvidence take() { return std::move(evidence_); }

 private:
  // A scan point at the line's very end may lie on a border: then its cell is one behind the path.
  void remember_hit(const Sensor& sensor, const BeamLine& line, std::uint32_t range_mm,
                    Plan& plan) {
    const Position hit = line.through({range_mm, sensor.range.mm()});
    plan.path_end = std::max(plan.path_end, std::int64_t{hit.crossed()} + 1);
    const Cell cell = line.cell(hit);
    if (geometry::kGridArea.contains(cell)) {
      evidence_.hits.push_back(
          static_cast<std::uint32_t>(cell.y * geometry::kCellsPerSide + cell.x));
    }
  }

  const vehicle::Vehicle* vehicle_;
  Sampling sampling_;
  Cells path_;  // of the point at hand
  FrameEvidence evidence_;
};

}  // namespace

FrameEvidence project(const vehicle::Vehicle& vehicle, const FramePoints& points,
                      Sampling sampling) {
  Projector projector(vehicle, sampling, points.size());
  for (const SensorPoint& point : points) {
    projector.add(point);
  }
  return projector.take();
}

}  // namespace iog::lab
