// Pulling what the window's cells find free in the vehicle's grid. look_up.cpp says what; CMake
// chooses how, look_up.cpp or look_up_neon.cpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "placing/placement.hpp"
#include "placing/slice_cells.hpp"

namespace iog::placing {

// Where eight cells of the window in a run lie in the vehicle's grid, worked out once for all runs
// of a slice.
//
// A run lies along that axis of the window which goes more along the grid's x. Seven steps of at
// most 2^16 and a fraction below it are less than eight cells, so a run has at most eight columns
// of the grid. The other part of a step is at most 2^16 / sqrt(2) and a half, seven are less than
// five cells, so it has at most six rows.
//
// Counted from the lowest column and row of a run, a cell lies as many further as there are whole
// ones in its steps, and one more if the fractions of both make a whole one. That is exact.
struct EightSteps {
  static constexpr std::int32_t kCount = 8;
  static constexpr std::int32_t kColumns = 8;
  static constexpr std::int32_t kMostRows = 6;
  using Eight = std::array<std::uint16_t, kCount>;

  // step: from a cell of the window to the next along x.
  explicit EightSteps(FinePoint step);

  FinePoint step;
  bool is_along_y;    // whether a run lies along the window's y
  FinePoint to_next;  // from a run to the next
  FinePoint to_low;   // from the first cell of a run to its lowest column and row
  std::int32_t rows;  // of the grid that a run has at most
  // By cell: kColumns times the whole rows in its steps, and the whole columns.
  alignas(16) Eight wholes;
  // By cell: up to which fraction of the lowest x, and y, the fractions make no whole one.
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

// Adds to the evidence of a tile what its cells find free (placing/slice_byte.hpp). The first one's
// centre lies at `first` in the grid, the others' by `steps`. False if nothing is known near.
bool pull_tile(const SliceCells& slice, FinePoint first, const EightSteps& steps,
               std::span<std::int8_t, geometry::kTileCells> evidence);

}  // namespace iog::placing
