// Applies beams to their lines. A beam lowers the indexes of the cells before its end and marks the
// cell of its hit. Beams that share a line are first accumulated as steps (free_steps.hpp) and then
// carved together.
//
// AzimuthCarver collects the beams of tilted rotating sensors and of sensors that measure in the
// same directions in every scan. TurnCarver collects the beams of level rotating lidars. Saturating
// sums of negative indexes commute (docs/model.md section 3), so the result does not depend on the
// order of the beams. For the same reason, the beams of a frame may be split among several carvers,
// each with its own grid. The saturating sum of these grids equals the grid of a single carver.
#pragma once

#include <algorithm>
#include <cstdint>

#include "grid/beam_lines.hpp"
#include "grid/frame_grids.hpp"
#include "grid/free_steps.hpp"
#include "grid/line_part.hpp"
#include "grid/pending_marks.hpp"
#include "vehicle/beam.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// A beam, given by the range of its point along the line and by how the point changes the grid.
struct WaitingBeam {
  std::uint32_t range_mm = 0;
  vehicle::Evidence evidence;
  bool is_tall = false;  // whether it is a tall return, if heights are kept
  bool ends_on_ground = false;
};

// A beam's line, together with the part that the beam can free and the range up to which the beam
// carves if it has no echo. `limits` is null if the beam can free the whole line within the grid.
struct BeamOnLine {
  const KeptLine& line;
  const FreePart* limits;
  std::uint32_t clears_mm;
};

class BeamCarver {
 public:
  // Both arguments must outlive the carver.
  BeamCarver(FrameGrids& grids, PendingMarks& marks)
      : grids_(&grids), marks_(&marks), keeps_heights_(grids.keep_heights) {}

  // Returns true if low beams and tall returns are recorded.
  [[nodiscard]] bool keeps_heights() const { return keeps_heights_; }

  // Carves and marks cells according to the beam's evidence. `steps_of(end)` returns the steps of
  // the line for a beam that ends at `end`. The steps must have room for one more beam. `low_of()`
  // returns the part of the line in which the beam is low.
  template <typename StepsOf, typename LowOf>
  [[gnu::always_inline]] void add(const vehicle::Sensor& sensor, const BeamOnLine& beam,
                                  const WaitingBeam& its, StepsOf&& steps_of, LowOf&& low_of);

  // Adds the zones of the sensor's profile to the steps, up to the end of `part`.
  // FreeSteps::begin_beam() must have been called. Returns the boundary at which the beam stops
  // freeing cells.
  static Between add_zones(const vehicle::Sensor& sensor, FreeSteps& steps, const KeptLine& line,
                           const LinePart& part, std::uint32_t range_mm);

  void mark(const vehicle::Sensor& sensor, const KeptLine& line, traversal::Position hit,
            std::uint32_t range_mm, bool is_tall) {
    marks_->mark(sensor, line, hit, range_mm, is_tall);
  }

  // Carves all pending beams in the steps and clears the steps.
  void carve(KeptLine& line, LineSteps& steps);

 private:
  template <typename Steps>
  static void carve(KeptLine& line, BlockGrid& grid, Steps& steps);
  [[nodiscard]] static LinePart less_over_ground(LinePart low, const vehicle::Sensor& sensor,
                                                 const KeptLine& line, const WaitingBeam& its);
  [[nodiscard, gnu::noinline]] static Between end_without_hit(const vehicle::Sensor& sensor,
                                                              const KeptLine& line,
                                                              std::uint32_t clears_mm,
                                                              std::uint32_t range_mm);

  FrameGrids* grids_;
  PendingMarks* marks_;
  bool keeps_heights_;
};

// For each grid cell before the point (marked * below), the code determines the 1D cell in which
// the line leaves the grid cell. The grid cell gets the index of this 1D cell or of 1D cell k - 1,
// whichever is nearer to the sensor. The example shows a beam of a LUX:
//
//    1D cells      k - 3   |   k - 2   |   k - 1   |     k     |
//    the line  S ----------+-----------+-----------+-------*---+-------> E
//    its cells     a   |   b    |  c  |    d    |   e   |    f     |
//    lowered by    14      7       7       0        0     marked, not carved
//    steps     +14       -7 at b         -7 at d
//
// The line leaves a cell in 1D cell j or earlier if and only if it crosses the cell's far border at
// distance (j + 1) * Delta or less. `through` is the number of borders that the line crosses within
// a given distance. In the example, the zone of 1D cell k - 2 therefore begins in grid cell b,
// which the line crosses at distance (k - 2) * Delta.
//
// This function is inline because a function call would cost as much as adding a zone.
[[gnu::always_inline]] inline Between BeamCarver::add_zones(const vehicle::Sensor& sensor,
                                                            FreeSteps& steps, const KeptLine& line,
                                                            const LinePart& part,
                                                            std::uint32_t range_mm) {
  const sensor_model::Profile& profile = sensor.profile;
  std::int32_t freer = -profile.free;
  Between last = part.first;
  const std::uint32_t k = sensor.precision.divide(range_mm);
  const std::uint32_t delta_mm = sensor.precision_mm;
  const std::uint32_t zones = range_mm > 0 ? profile.near_before_count : 0;
  std::uint32_t begin_mm = (k - zones) * delta_mm;
  for (std::uint32_t back = zones; back > 0; --back, begin_mm += delta_mm) {
    // The zone begins where 1D cell k - back begins, at distance (k - back) * Delta.
    const Between zone = k < back ? part.first : Between::before(line.through(sensor, begin_mm));
    const std::int32_t in_zone = -profile.near_before[back - 1];
    last = std::clamp(zone, part.first, part.end);
    steps.add(last, in_zone - freer);
    freer = in_zone;
  }
  if (freer != 0) {
    last = part.end;
    steps.add(last, -freer);
  }
  return last;
}

// Shortens the low part of a beam that ends on the ground. On a rising road, a beam can be within
// the height band above the car's plane but below the band above the road. Such a beam may pass
// under a car. The beam is therefore compared with a straight line from the ground below the sensor
// to the point where the beam meets the ground. It is treated as low only where it is high enough
// above this line.
inline LinePart BeamCarver::less_over_ground(LinePart low, const vehicle::Sensor& sensor,
                                             const KeptLine& line, const WaitingBeam& its) {
  if (its.ends_on_ground) {
    const std::uint32_t over_mm = vehicle::along_line_mm(its.range_mm, sensor.share_over_ground);
    low.end = std::min(low.end, Between::after(line.through(sensor, over_mm)));
  }
  return low;
}

// If the point is far beyond the part of the line that the beam can free, the beam frees this whole
// part.
template <typename StepsOf, typename LowOf>
inline void BeamCarver::add(const vehicle::Sensor& sensor, const BeamOnLine& beam,
                            const WaitingBeam& its, StepsOf&& steps_of, LowOf&& low_of) {
  const KeptLine& line = beam.line;
  const std::uint32_t range_mm = its.range_mm;
  const auto add_low = [&](LineSteps& steps, const LinePart& freed) {
    if (keeps_heights()) {
      steps.add_low(freed.within(less_over_ground(low_of(), sensor, line, its)));
    }
  };
  const LinePart& limits = beam.limits == nullptr ? line.in_grid() : beam.limits->part;
  if (beam.limits != nullptr && range_mm >= beam.limits->free_from_mm) {
    const LinePart& part = limits;
    if (!part.is_empty()) {
      const std::int32_t freer = -sensor.profile.free;
      LineSteps& steps = steps_of(part.end);
      steps.free.begin_beam(part.first, freer);
      steps.free.add(part.end, -freer);
      steps.free.end_beam(part.end);
      add_low(steps, part);
    }
    if (its.evidence.marks()) {
      mark(sensor, line, line.through(sensor, range_mm), range_mm, its.is_tall);
    }
    return;
  }
  const bool has_hit = range_mm - 1 < sensor.range.mm();
  const traversal::Position hit = has_hit ? line.through(sensor, range_mm) : traversal::Position{};
  if (its.evidence.carves()) {
    const Between end =
        has_hit ? Between::before(hit) : end_without_hit(sensor, line, beam.clears_mm, range_mm);
    const LinePart part = limits.up_to(end);
    if (!part.is_empty()) {
      LineSteps& steps = steps_of(part.end);
      steps.free.begin_beam(part.first, -sensor.profile.free);
      const Between last = add_zones(sensor, steps.free, line, part, range_mm);
      steps.free.end_beam(part.end);
      add_low(steps, {part.first, last});
    }
  }
  if (its.evidence.marks()) {
    mark(sensor, line, hit, range_mm, its.is_tall);
  }
}

}  // namespace iog::grid
