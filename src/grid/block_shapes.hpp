// Defines a one-byte code that describes which cells of a 4 by 4 block a line crosses.
//
// A line that does not pass through a corner is mirrored and transposed, so that it runs in the
// positive direction of both axes and rises by at most one cell per column. `u` is the column
// number along the line's longer axis, and `v` is the row number along the other axis. Such a line
// can enter a block in the seven numbered cells:
//
//     v
//     3 | 3  .  .  . |
//     2 | 2  .  .  . |
//     1 | 1  .  .  . |
//     0 | 0  4  5  6 |
//       u 0  1  2  3
//
// Entry 7 is one column beyond entry 6, outside the block.
//
// In each column, the line crosses at most one row border. Seven bits, called the block's *shape*,
// are therefore enough to determine the cells that the line crosses and the border through which it
// leaves the block. Three bits encode the entry, and the other four bits represent one column each.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "grid/block_grid.hpp"

namespace iog::grid {

// The cell in which a line enters a block. Entries 0 to 3 are the cells (u, v) = (0, entry), and
// entries 4 to 7 are the cells (entry - 3, 0).
using BlockEntry = std::uint32_t;
[[nodiscard]] constexpr BlockEntry entered_from_below(std::uint32_t u) {
  return u == 0 ? 0 : u + 3;
}

// A shape combines a BlockEntry with four bits. Bit j is set if the line crosses a row border in
// the column that is j columns after the entry's column.
inline constexpr std::uint32_t kShapeCount = 128;
[[nodiscard]] constexpr std::uint32_t shape_of(BlockEntry entry, std::uint32_t bits) {
  return entry << 4 | bits;
}

// The code of a block on a line is twice the block's shape, plus 1 if the line leaves the block
// through a row border. If the line does not enter a column in this block, the column's bit is 0.
// Two lines therefore have the same code if and only if they cross the same cells of the block and
// leave the block through the same border.
using BlockCode = std::uint8_t;

// The one or two blocks that a line crosses in one column of blocks. The lower block comes first.
struct BlockColumn {
  std::array<BlockCode, 2> codes{};
  std::uint8_t count = 0;
  std::uint8_t next_v = 0;  // row in which the line enters the next column of blocks
};

// The orientation of u and v in the grid. `u` corresponds to y if `is_steep`, and otherwise to x.
// Either u or v, or both, can run in the negative direction.
struct Orientation {
  bool is_steep = false;
  bool x_is_negative = false;
  bool y_is_negative = false;

  [[nodiscard]] static constexpr Orientation of(std::size_t number) {
    return {.is_steep = (number & 4U) != 0,
            .x_is_negative = (number & 1U) != 0,
            .y_is_negative = (number & 2U) != 0};
  }
  [[nodiscard]] constexpr std::size_t number() const {
    return (x_is_negative ? 1U : 0U) + (y_is_negative ? 2U : 0U) + (is_steep ? 4U : 0U);
  }
  // Returns the strides in an array with `row` elements per row.
  [[nodiscard]] constexpr Strides strides(std::ptrdiff_t row) const {
    const std::ptrdiff_t along_x = x_is_negative ? -1 : 1;
    const std::ptrdiff_t along_y = y_is_negative ? -row : row;
    return is_steep ? Strides{along_y, along_x} : Strides{along_x, along_y};
  }
  // Returns the position of a cell in its block (`4 * y + x`). The arguments are the cell's
  // coordinates in the block, counted along each axis in the direction in which the line runs.
  [[nodiscard]] constexpr std::uint32_t inner_of(std::uint32_t along_x,
                                                 std::uint32_t along_y) const {
    const std::uint32_t mirrored = (x_is_negative ? 3U : 0U) | (y_is_negative ? 12U : 0U);
    return (4 * along_y + along_x) ^ mirrored;
  }
  [[nodiscard]] constexpr std::uint32_t inner(std::uint32_t u, std::uint32_t v) const {
    return is_steep ? inner_of(v, u) : inner_of(u, v);
  }
};

// The cell masks of a block for lines of one orientation. A byte is -1 if its cell is selected, and
// 0 otherwise.
struct BlockMasks {
  // The cells that a line crosses, indexed by shape.
  std::array<LaneBytes, kShapeCount> of_shape{};
  // For each position in a block, the cells that a line can still cross once it has reached the
  // cell at this position. `from` includes this cell, and `after` excludes it.
  std::array<LaneBytes, kLaneCount> from{};
  std::array<LaneBytes, kLaneCount> after{};
};

// The index into this table is `16 * v + mask`. `v` is the row in which the line enters the column
// of blocks from the left. Each of the four bits of `mask` represents one column of cells, with the
// first column in the highest bit. A bit is set if the line crosses a row border within the bit's
// column.
extern const std::array<BlockColumn, 64> kBlockColumns;

// Indexed by Orientation::number().
extern const std::array<BlockMasks, 8> kBlockMasks;

}  // namespace iog::grid
