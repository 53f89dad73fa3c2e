// How far the images of a rectangle of cells reach in the other grid.
#pragma once

#include <algorithm>
#include <cstdint>

#include "geometry/cell.hpp"
#include "placing/placement.hpp"

namespace iog::placing {

// The cells of one grid in which the centres of a rectangle of the other's cells lie at most: from
// the image of its first cell to `low` and to `high`, both included.
struct Reach {
  FinePoint to_low;
  FinePoint to_high;

  static Reach of_square(std::int32_t side, FinePoint step) { return of(side, side, step); }
  static Reach of(std::int32_t columns, std::int32_t rows, FinePoint step) {
    const FinePoint across{(columns - 1) * step.x, (columns - 1) * step.y};
    const FinePoint up{-(rows - 1) * step.y, (rows - 1) * step.x};
    constexpr std::int32_t kHere = 0;
    return {.to_low = {std::min(across.x, kHere) + std::min(up.x, kHere),
                       std::min(across.y, kHere) + std::min(up.y, kHere)},
            .to_high = {std::max(across.x, kHere) + std::max(up.x, kHere),
                        std::max(across.y, kHere) + std::max(up.y, kHere)}};
  }

  [[nodiscard]] geometry::Cell low(FinePoint first) const { return along_x(first, to_low).cell(); }
  [[nodiscard]] geometry::Cell high(FinePoint first) const {
    return along_x(first, to_high).cell();
  }
};

}  // namespace iog::placing
