// Rasterises polygons: finds the cells of a tile's frame whose centre is inside.
//
// A row is a word, the lowest y first; bit i is the cell of column i. By the even-odd rule, a
// centre is inside if the edges cross its row an odd number of times at or to the left of it. An
// edge crosses the rows from its lower end (included) to its upper end (excluded). So borders are
// half open: polygons that share an edge share no cell and leave no gap. The only inexact step is
// the rounding of vertices to fine units (map/tile_place.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "map/tile_place.hpp"

namespace iog::map {

// One bit for each cell of a tile's frame.
struct alignas(16) FrameBits {
  std::array<std::uint64_t, kFrameSide> rows{};
};

// The range of rows, and of columns, within a distance of the tile.
struct RowRange {
  std::int32_t first = 0;
  std::int32_t end = kFrameSide;  // exclusive

  [[nodiscard]] constexpr bool is_empty() const { return first >= end; }
  [[nodiscard]] static constexpr RowRange around_tile(std::int32_t cells) {
    return {kHalo - cells, kHalo + window::kTileSide + cells};
  }
};

// Takes the edges of a polygon in any order, then returns its inside.
class Raster {
 public:
  // Discards all edges. Results are valid only for these rows, and for the columns of the same
  // range.
  void clear(RowRange rows);

  // The rows that an edge between these heights crosses. If there are none, it need not be added.
  [[nodiscard]] RowRange crossed(std::int32_t from_y, std::int32_t to_y) const {
    return {std::max(first_from(std::min(from_y, to_y)), wanted_.first),
            std::min(first_from(std::max(from_y, to_y)), wanted_.end)};
  }

  // Whether a polygon in this box can have a cell in the valid range.
  [[nodiscard]] bool reaches(const FineBox& box) const {
    return !crossed(box.low.y, box.high.y).is_empty() && first_from(box.low.x) < wanted_.end &&
           first_from(box.high.x) > wanted_.first;
  }

  // Differences of coordinates must be below 2^30.2. rows: those that the edge crosses, at least
  // one.
  void add_edge(RowRange rows, FinePoint from, FinePoint to);

  // Adds the inside to `bits`, and clears the raster for the next polygon.
  void add_to(FrameBits& bits);

 private:
  // The first row or column whose centre is not below `fine`.
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
