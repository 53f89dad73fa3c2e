// Gathers free space from the slice grid into window cells. `look_up.cpp` is the reference
// implementation. CMake selects either look_up.cpp or look_up_neon.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "placing/placement.hpp"
#include "placing/slice_cells.hpp"

namespace iog::placing {

// Maps a run of eight window cells to the slice grid. The steps between the cells of a run are the
// same for all runs of a slice, so they are computed only once.
//
// A run follows the window axis that is closer to the grid's x axis. Coordinates are in units of
// 2^-16 cells. The step from one cell of a run to the next is at most 2^16 units (one cell) along
// the grid's x axis. Seven such steps plus a fraction of a cell span less than eight cells, so a
// run covers at most eight columns of the grid. Along the grid's y axis, the step is at most 2^16 /
// sqrt(2) + 1/2 units. Seven such steps span less than five cells, so a run covers at most six
// rows.
//
// The step values of a cell are its distances from the minimum x and y of its run. The column
// offset of a cell is counted from the lowest column of the run. This offset is the integer part of
// the x step value, plus 1 if the fractional parts of the step value and the minimum x add up to at
// least 1. Row offsets are computed in the same way from y. The result is exact.
struct EightSteps {
  static constexpr std::int32_t kCount = 8;
  static constexpr std::int32_t kColumns = 8;
  static constexpr std::int32_t kMostRows = 6;
  using Eight = std::array<std::uint16_t, kCount>;

  // `step` is the step from one window cell to the next along x, transformed into the slice grid.
  explicit EightSteps(FinePoint step);

  FinePoint step;
  bool is_along_y;    // whether a run follows the window's y axis
  FinePoint to_next;  // from one run to the next
  FinePoint to_low;   // from the first cell of a run to its lowest column and row
  std::int32_t rows;  // maximum number of grid rows that a run covers
  // The value for each cell is `kColumns * row + column`, where `row` and `column` are the integer
  // parts of the cell's step values.
  alignas(16) Eight wholes;
  // If the fractional part of the minimum x (or y) exceeds a cell's value here, 1 is added to the
  // cell's offset.
  alignas(16) Eight most_x;
  alignas(16) Eight most_y;
};

inline EightSteps::EightSteps(FinePoint along_window_x)
    : step(along_window_x),
      is_along_y(std::max(step.x, -step.x) < std::max(step.y, -step.y)),
      to_next(is_along_y ? step : FinePoint{-step.y, step.x}) {
  constexpr std::int32_t kFraction = (1 << kFineBits) - 1;
  const FinePoint one = is_along_y ? FinePoint{-step.y, step.x} : step;
  constexpr std::int32_t kLast = kCount - 1;
  constexpr std::int32_t kNone = 0;
  to_low = {std::min(kLast * one.x, kNone), std::min(kLast * one.y, kNone)};
  rows = ((std::max(one.y, -one.y) * kLast + kFraction) >> kFineBits) + 1;
  for (std::int32_t i = 0; i < kCount; ++i) {
    const FinePoint from_low{i * one.x - to_low.x, i * one.y - to_low.y};
    const auto at = static_cast<std::size_t>(i);
    wholes[at] = static_cast<std::uint16_t>((from_low.y >> kFineBits) * kColumns +
                                            (from_low.x >> kFineBits));
    most_x[at] = static_cast<std::uint16_t>(kFraction - (from_low.x & kFraction));
    most_y[at] = static_cast<std::uint16_t>(kFraction - (from_low.y & kFraction));
  }
}

// Merges the free space of the slice grid into the evidence of a tile (placing/slice_byte.hpp).
// `first` is the image of the tile's first cell. The images of the other cells are computed from
// `steps`. Returns false if all cells near the tile are unknown.
bool pull_tile(const SliceCells& slice, FinePoint first, const EightSteps& steps,
               std::span<std::int8_t, geometry::kTileCells> evidence);

}  // namespace iog::placing
