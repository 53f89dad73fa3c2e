// What a line covers of a block of 4 by 4 cells, as a code of one byte.
//
// A line that meets no corner is folded so that it runs towards plus on both axes and rises by at
// most one cell a column: u counts columns along the axis on which the line is longer, v along the
// other. In each column it then crosses at most one border of v before it leaves the column. So the
// cell in which it enters a block, one of 4 on the left and 3 more below, and one bit for each of
// the next four columns say which cells of the block it passes through, and how it leaves: 7 bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "grid/block_grid.hpp"

namespace iog::grid {

// A block's cell in which a line enters it: 0 ... 3 is (u, v) = (0, entry), 4 ... 6 is (entry - 3,
// 0).
using BlockEntry = std::uint32_t;

[[nodiscard]] constexpr BlockEntry entered_from_the_left(std::uint32_t v) { return v; }
[[nodiscard]] constexpr BlockEntry entered_from_below(std::uint32_t u) {
  return u == 0 ? 0 : u + 3;
}

// Entry and bits: bit j says that the line crosses a border of v in the column j after the entry's.
inline constexpr std::uint32_t kShapeCount = 128;
[[nodiscard]] constexpr std::uint32_t shape_of(BlockEntry entry, std::uint32_t bits) {
  return entry << 4 | bits;
}

// A block of a line: twice its shape, and 1 if the line leaves it through a border of v. Of the
// bits only those of columns that the line enters in this block: two lines have the same code
// exactly if they have the same cells and leave by the same border.
using BlockCode = std::uint8_t;

// What the line does in a block of this shape.
struct BlockPassage {
  std::uint8_t u_borders = 0;  // how many it crosses, the block's own included
  std::uint8_t v_borders = 0;
  std::uint8_t next_entry = 0;
  BlockCode code = 0;
};

// How u and v lie in the grid: u is x, or y if `is_steep`; each may run towards minus.
struct Orientation {
  bool is_steep = false;
  bool x_is_negative = false;
  bool y_is_negative = false;

  [[nodiscard]] constexpr std::size_t quadrant() const {
    return (x_is_negative ? 1U : 0U) + (y_is_negative ? 2U : 0U);
  }
  [[nodiscard]] constexpr std::size_t number() const { return quadrant() + (is_steep ? 4U : 0U); }
  // Where the cell (u, v) of a block lies in it: 4 y + x.
  [[nodiscard]] constexpr std::uint32_t inner(std::uint32_t u, std::uint32_t v) const {
    const std::uint32_t along_x = is_steep ? v : u;
    const std::uint32_t along_y = is_steep ? u : v;
    const std::uint32_t x = x_is_negative ? 3 - along_x : along_x;
    const std::uint32_t y = y_is_negative ? 3 - along_y : along_y;
    return 4 * y + x;
  }
};

using ShapeMasks = std::array<LaneBytes, kShapeCount>;
using InnerMasks = std::array<LaneBytes, kLaneCount>;

extern const std::array<BlockPassage, kShapeCount> kPassages;

// By Orientation::number(): the cells of each shape, all bits of theirs set.
extern const std::array<ShapeMasks, 8> kShapeMasks;

// By Orientation::quadrant(): of all cells that a line may pass through in a block, those from this
// inner cell on; and by the same, those after it.
extern const std::array<InnerMasks, 4> kFromMasks;
extern const std::array<InnerMasks, 4> kAfterMasks;

}  // namespace iog::grid
