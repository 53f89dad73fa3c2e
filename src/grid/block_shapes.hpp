// Which cells of a block of 4 by 4 a line goes through, as a code of one byte.
//
// A line that meets no corner is folded so that it runs towards plus on both axes and rises by at
// most one cell a column: u counts columns along the axis on which the line is longer, v along the
// other. There are seven cells in which such a line can enter a block, numbered
//
//     v
//     3 | 3  .  .  . |
//     2 | 2  .  .  . |
//     1 | 1  .  .  . |
//     0 | 0  4  5  6 |
//       u 0  1  2  3
//
// Entry 7 is one column further than 6, where the block has no cell.
//
// In each column it then crosses at most one border of v before it leaves the column. So the entry
// and one bit for each of the next four columns, seven bits in all, say which cells of the block
// the line goes through, and how it leaves. These seven bits are the block's *shape*.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "grid/block_grid.hpp"

namespace iog::grid {

// The cell in which a line enters a block: 0 ... 3 is (u, v) = (0, entry), 4 ... 7 is (entry - 3,
// 0).
using BlockEntry = std::uint32_t;
[[nodiscard]] constexpr BlockEntry entered_from_below(std::uint32_t u) {
  return u == 0 ? 0 : u + 3;
}

// A shape: the entry, and four bits. Bit j is set if the line crosses a border of v in the column j
// places after that of the entry.
inline constexpr std::uint32_t kShapeCount = 128;
[[nodiscard]] constexpr std::uint32_t shape_of(BlockEntry entry, std::uint32_t bits) {
  return entry << 4 | bits;
}

// The code of a block of a line: twice its shape, and 1 more if the line leaves the block through a
// border of v. Bits of columns that the line does not enter in this block are 0. So two lines have
// the same code exactly if they have the same cells in the block and leave it by the same border.
using BlockCode = std::uint8_t;

// The blocks of one column of blocks that a line goes through, one or two, the lower one first.
struct BlockColumn {
  std::array<BlockCode, 2> codes{};
  std::uint8_t count = 0;
  std::uint8_t next_v = 0;  // where the line enters the next column of blocks
};

// How u and v lie in the grid. u is x, or y if `is_steep`. Each may run towards minus.
struct Orientation {
  bool is_steep = false;
  bool x_is_negative = false;
  bool y_is_negative = false;

  [[nodiscard]] constexpr std::size_t number() const {
    return (x_is_negative ? 1U : 0U) + (y_is_negative ? 2U : 0U) + (is_steep ? 4U : 0U);
  }
  // How far the next place along u lies, and that along v, in rows of so many places.
  struct Strides {
    std::ptrdiff_t u;
    std::ptrdiff_t v;
  };
  [[nodiscard]] constexpr Strides strides(std::ptrdiff_t row) const {
    const std::ptrdiff_t along_x = x_is_negative ? -1 : 1;
    const std::ptrdiff_t along_y = y_is_negative ? -row : row;
    return is_steep ? Strides{along_y, along_x} : Strides{along_x, along_y};
  }
  // The place of a cell in its block, 4 y + x. It is so far along each axis in the line's own
  // direction.
  [[nodiscard]] constexpr std::uint32_t inner_of(std::uint32_t along_x,
                                                 std::uint32_t along_y) const {
    const std::uint32_t mirrored = (x_is_negative ? 3U : 0U) | (y_is_negative ? 12U : 0U);
    return (4 * along_y + along_x) ^ mirrored;
  }
  [[nodiscard]] constexpr std::uint32_t inner(std::uint32_t u, std::uint32_t v) const {
    return is_steep ? inner_of(v, u) : inner_of(u, v);
  }
};

// Cells of a block, for lines of one orientation. A byte is -1 for a cell that counts, else 0.
struct BlockMasks {
  // By shape: the cells through which the line goes.
  std::array<LaneBytes, kShapeCount> of_shape{};
  // By a cell's place in the block: the cells that a line can still go through from this cell on,
  // itself included; and without itself.
  std::array<LaneBytes, kLaneCount> from{};
  std::array<LaneBytes, kLaneCount> after{};
};

// By v where the line enters the column of blocks from the left, times 16, and four bits, one for
// each column of cells: set if the line crosses a border of v there, the first one uppermost.
extern const std::array<BlockColumn, 64> kBlockColumns;

// By Orientation::number().
extern const std::array<BlockMasks, 8> kBlockMasks;

}  // namespace iog::grid
