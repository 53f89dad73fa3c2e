// What a beam does to its line: it makes the cells before its end freer, and marks the cell of its
// hit. Beams of one line wait in its steps and are carved together.
//
// Which beams wait for which is a carver's: azimuth_carver.hpp has the units that look into the
// same directions in every scan, turn_carver.hpp those that turn. Saturated sums of negative
// indexes commute (docs/model.md section 3), so the order in which beams carve does not show. For
// the same reason the beams of a frame may be divided among carvers, each with a grid of its own;
// the saturated sum of their grids is the grid of one carver.
#pragma once

#include <algorithm>
#include <cstdint>

#include "grid/beam_lines.hpp"
#include "grid/block_grid.hpp"
#include "grid/free_steps.hpp"
#include "grid/line_part.hpp"
#include "grid/pending_marks.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

class BeamCarver {
 public:
  // All three outlive it.
  BeamCarver(const vehicle::Vehicle& vehicle, BlockGrid& grid, PendingMarks& marks)
      : vehicle_(&vehicle), grid_(&grid), marks_(&marks) {}

  // Carves and marks as its fate says. Beam: KeptBeam or TurnBeam. steps_of(beam, end) are the
  // steps in which beams of its line wait, with room for this one, which ends there.
  template <typename Beam, typename StepsOf>
  void take(const vehicle::Sensor& sensor, Beam&& beam, vehicle::Classification its,
            std::uint32_t range_mm, StepsOf&& steps_of);

  // The changes of a beam behind its beginning: zones of its profile, up to the part's end.
  static void add_zones(const vehicle::Sensor& sensor, FreeSteps& steps, const KeptLine& line,
                        const LinePart& part, std::uint32_t range_mm);

  void mark(const vehicle::Sensor& sensor, const KeptLine& line, traversal::Position hit,
            std::uint32_t range_mm) {
    marks_->mark(sensor, line, hit, range_mm);
  }

  // Carves what waits in the steps. Then nothing does.
  void carve(KeptLine& line, FreeSteps& steps);

 private:
  [[nodiscard, gnu::noinline]] static Between end_without_hit(const vehicle::Sensor& sensor,
                                                              const KeptLine& line,
                                                              std::uint32_t clears_mm,
                                                              std::uint32_t range_mm);

  const vehicle::Vehicle* vehicle_;
  BlockGrid* grid_;
  PendingMarks* marks_;
};

// A cell before the scan point * takes the index of the 1D cell in which the line leaves it, at
// most k - 1. For a LUX:
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
//
// Inline, because a call costs as much as a zone.
[[gnu::always_inline]] inline void BeamCarver::add_zones(const vehicle::Sensor& sensor,
                                                         FreeSteps& steps, const KeptLine& line,
                                                         const LinePart& part,
                                                         std::uint32_t range_mm) {
  const sensor_model::Profile& profile = sensor.profile;
  std::int32_t freer = -profile.free;
  const std::uint32_t k = sensor.precision.divide(range_mm);
  const std::uint32_t delta_mm = sensor.precision_mm;
  const std::uint32_t zones = range_mm > 0 ? profile.near_before_count : 0;
  std::uint32_t begin_mm = (k - zones) * delta_mm;
  for (std::uint32_t back = zones; back > 0; --back, begin_mm += delta_mm) {
    // 1D cells from k - back on, which begin at (k - back) Delta.
    const Between zone = k < back ? part.first : Between::before(line.through(sensor, begin_mm));
    const std::int32_t in_zone = -profile.near_before[back - 1];
    steps.add(std::clamp(zone, part.first, part.end), in_zone - freer);
    freer = in_zone;
  }
  if (freer != 0) {
    steps.add(part.end, -freer);
  }
}

// Where the scan point is far behind the part of its line in the height band, the part is simply
// free.
template <typename Beam, typename StepsOf>
inline void BeamCarver::take(const vehicle::Sensor& sensor, Beam&& beam,
                             vehicle::Classification its, std::uint32_t range_mm,
                             StepsOf&& steps_of) {
  const KeptLine& line = beam.line();
  const bool leaves_band = its.carves && !its.is_whole_in_band;
  const LinePart limits = leaves_band ? beam.in_band(*vehicle_, sensor) : line.in_grid();
  if (leaves_band && range_mm >= beam.is_free_before_mm()) {
    if (!limits.is_empty()) {
      const std::int32_t freer = -sensor.profile.free;
      FreeSteps& steps = steps_of(beam, limits.end);
      steps.begin_beam(limits.first, freer);
      steps.add(limits.end, -freer);
      steps.end_beam(limits.end);
    }
    if (its.marks) {
      mark(sensor, line, line.through(sensor, range_mm), range_mm);
    }
    return;
  }
  const bool has_hit = range_mm - 1 < sensor.range.mm();
  const traversal::Position hit = has_hit ? line.through(sensor, range_mm) : traversal::Position{};
  if (its.carves) {
    const Between end =
        has_hit ? Between::before(hit) : end_without_hit(sensor, line, beam.clears_mm(), range_mm);
    const LinePart part{limits.first, std::min(limits.end, end)};
    if (!part.is_empty()) {
      FreeSteps& steps = steps_of(beam, part.end);
      steps.begin_beam(part.first, -sensor.profile.free);
      add_zones(sensor, steps, line, part, range_mm);
      steps.end_beam(part.end);
    }
  }
  if (its.marks) {
    mark(sensor, line, hit, range_mm);
  }
}

}  // namespace iog::grid
