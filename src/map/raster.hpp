// Rasterises polygons. The raster finds the cells of a tile's frame whose centres are inside a
// polygon.
//
// Each row is stored in a word, starting with the lowest y. Bit i represents the cell in column i.
// According to the even-odd rule, a centre is inside the polygon if an odd number of edges cross
// its row at or to the left of the centre. An edge crosses the rows from its lower end (inclusive)
// to its upper end (exclusive). Row intervals are therefore half-open. As a result, polygons that
// share an edge neither overlap nor leave a gap. The only inexact step is the rounding of vertices
// to fine units (map/tile_place.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "map/tile_place.hpp"

namespace iog::map {

// One bit for each cell of a tile's frame.
struct alignas(16) FrameBits {
  std::array<std::uint64_t, kFrameSide> rows{};
};

// A range of rows or columns in a tile's frame.
struct RowRange {
  std::int32_t first = 0;
  std::int32_t end = kFrameSide;  // exclusive

  [[nodiscard]] constexpr bool is_empty() const { return first >= end; }
  [[nodiscard]] static constexpr RowRange around_tile(std::int32_t cells) {
    return {kHalo - cells, kHalo + window::kTileSide + cells};
  }
};

// Collects the edges of a polygon in any order, and then returns the cells inside the polygon.
class Raster {
 public:
  // Discards all edges. After this call, results are valid only for cells whose row and column are
  // in the range `rows`.
  void clear(RowRange rows);

  // Returns the rows that an edge from `from_y` to `to_y` crosses. Edges that cross no row can be
  // omitted.
  [[nodiscard]] RowRange crossed(std::int32_t from_y, std::int32_t to_y) const {
    return {std::max(first_from(std::min(from_y, to_y)), wanted_.first),
            std::min(first_from(std::max(from_y, to_y)), wanted_.end)};
  }

  // Returns true if a polygon within this box can contain a cell in the valid range.
  [[nodiscard]] bool reaches(const FineBox& box) const {
    return !crossed(box.low.y, box.high.y).is_empty() && first_from(box.low.x) < wanted_.end &&
           first_from(box.high.x) > wanted_.first;
  }

  // Adds an edge. The coordinates of its ends must differ by less than 2^30.2. `rows` contains the
  // rows that the edge crosses. The edge must cross at least one row.
  void add_edge(RowRange rows, FinePoint from, FinePoint to);

  // Adds the cells inside the polygon to `bits`, and clears the raster for the next polygon.
  void add_to(FrameBits& bits);

 private:
  // Returns the first row or column whose centre is at or above `fine`.
  [[nodiscard]] static std::int32_t first_from(std::int32_t fine) {
    return (fine + kFine / 2 - 1) >> kFineBits;
  }
  void toggle(RowRange rows, std::uint64_t cells);
  void cross(RowRange rows, FinePoint low, FinePoint high);

  RowRange wanted_{};
  RowRange touched_{kFrameSide, 0};
  FrameBits odd_{};  // cells with an odd number of crossings
};

}  // namespace iog::map
