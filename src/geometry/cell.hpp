// Grid cells, and points in units of subcells.
#pragma once

#include <cstdint>

namespace iog::geometry {

// A point in subcells.
struct SubcellPoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

// A cell, given by its column and row. A cell may lie outside any grid.
struct Cell {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend constexpr bool operator==(const Cell&, const Cell&) = default;
};

// Contains the cells with `0 <= x < width` and `0 <= y < height`.
struct CellArea {
  std::int32_t width = 0;
  std::int32_t height = 0;
  [[nodiscard]] constexpr bool contains(Cell cell) const {
    return cell.x >= 0 && cell.x < width && cell.y >= 0 && cell.y < height;
  }
};

}  // namespace iog::geometry
