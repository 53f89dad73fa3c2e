// The marks of a frame, stored until all beams are carved. A mark increases the occupancy index of
// a cell that contains a point.
//
// Marks commute with each other, but not with carving.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "grid/beam_lines.hpp"
#include "grid/frame_grids.hpp"
#include "index/occupancy_index.hpp"
#include "require/require.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::grid {

// A cell marked by a point.
struct Mark {
  std::uint32_t cell : 24;    // cell number in rows of kLongestSide cells
  std::uint32_t is_tall : 1;  // whether the point is a tall return, if heights are kept
  std::uint32_t index : 7;    // 1 ... 127
};
static_assert(geometry::kLongestSide <= 1 << 12 && sizeof(Mark) == 4);

// The maximum number of marks per frame. The marks use 1 MiB. This number is enough for one turn of
// any of the following: a sensor with 128 layers and 2,048 azimuths, two sensors with 64 layers
// each, or a Pandar64 with two returns (230,400 points).
inline constexpr std::size_t kMaxMarks = 262'144;

// Returns the step along an arc, in ticks. This is the largest number of ticks whose arc at this
// range is at most one cell long. If even one tick is longer than a cell, the step is one tick. The
// constant for 2 * pi is rounded up, so the step is never too long.
[[nodiscard]] constexpr std::int32_t arc_step_ticks(const vehicle::Sensor& sensor,
                                                    std::uint32_t range_mm) {
  constexpr std::uint64_t kTwoPi = 6'283'186;
  const std::uint64_t at_one_mm =
      std::uint64_t{sensor.azimuths.ticks_per_turn()} * sensor.grid.cell_mm * 1'000'000 / kTwoPi;
  const std::uint32_t ticks =
      static_cast<std::uint32_t>(at_one_mm) / std::max<std::uint32_t>(range_mm, 1);
  return static_cast<std::int32_t>(std::max<std::uint32_t>(ticks, 1));
}

// Returns the maximum number of cells that one point of this sensor can mark. If the sensor has an
// arc, the maximum is the number of steps of the longest arc. Otherwise, a point can mark its own
// cell and the cells within `near_after_count` 1D cells behind it (see the sensor's profile). A
// line of length `d` enters at most `sqrt(2) * d / cell + 2` further cells.
[[nodiscard]] constexpr std::uint32_t max_marks_per_point(const vehicle::Sensor& sensor) {
  if (sensor.arc.is_given()) {
    const std::int32_t step = arc_step_ticks(sensor, sensor.range.mm());
    return 1 + 2 * static_cast<std::uint32_t>(sensor.arc.reach_ticks() / step);
  }
  const std::uint32_t near_mm = sensor.profile.near_after_count == 0
                                    ? 0
                                    : (sensor.profile.near_after_count + 1U) * sensor.precision_mm;
  return near_mm == 0 ? 1 : 1 + 2 + near_mm * 3 / (2 * sensor.grid.cell_mm);
}

class PendingMarks {
 public:
  // Stores the marks of a point. A point marks its own cell and, for some sensors, the next cells
  // behind it. `hit` is the point's position on the line.
  void mark(const vehicle::Sensor& sensor, const KeptLine& line, traversal::Position hit,
            std::uint32_t range_mm, bool is_tall) {
    const geometry::Cell cell = line.line().cell(hit);
    if (sensor.grid.area().contains(cell)) {
      remember(cell, sensor.profile.hit, is_tall);
    }
    if (sensor.profile.near_after_count > 0 && !line.in_grid().is_empty()) {
      mark_behind(sensor, line, hit, range_mm, is_tall);
    }
  }

  // Stores a mark for the given cell.
  void mark(const vehicle::Sensor& sensor, geometry::Cell cell, OccupancyIndex index) {
    if (sensor.grid.area().contains(cell)) {
      remember(cell, index, true);
    }
  }

  // Applies all marks to the grids according to the fusion rule, and clears the marks. Call this
  // function only after all beams of the frame are carved.
  void apply(FrameGrids& grids, vehicle::FusionRule rule);

  void clear() { count_ = 0; }

 private:
  void mark_behind(const vehicle::Sensor& sensor, const KeptLine& line, traversal::Position hit,
                   std::uint32_t range_mm, bool is_tall);
  template <bool kWithHeights>
  void apply(FrameGrids& grids, vehicle::FusionRule rule) const;

  void remember(geometry::Cell cell, OccupancyIndex index, bool is_tall) {
    require(count_ < kMaxMarks);
    const std::int32_t number = geometry::number_of(cell, geometry::kLongestSide);
    marks_[count_] = {static_cast<std::uint32_t>(number) & 0xFFFFFFU,
                      static_cast<std::uint32_t>(is_tall) & 1U,
                      static_cast<std::uint32_t>(index) & 0x7FU};
    ++count_;
  }

  std::size_t count_ = 0;
  std::array<Mark, kMaxMarks> marks_{};
};

}  // namespace iog::grid
