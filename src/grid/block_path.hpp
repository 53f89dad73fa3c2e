// The blocks that a line crosses, in order. The path stores one byte per block, and each block is
// computed only once. Block 0 contains the line's start.
//
// The line does not pass through a corner after its start, so consecutive blocks share a border.
// The line therefore crosses n block borders to reach block n. If a line starts at a corner where
// blocks meet, it crosses no cells of block 1.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "grid/block_shapes.hpp"
#include "traversal/dda.hpp"
#include "vehicle/beam_line.hpp"

namespace iog::grid {

// A cursor on a block path. The cursor consists of the current block, the block's code, and the
// codes of the following blocks. The code determines which of the two strides leads to the next
// block. The mask `masks[code / 2]` selects the cells that the line crosses in the block.
struct Way {
  const LaneBytes* masks;
  Strides strides;
  LaneBytes* block;
  std::uint32_t code;
  const BlockCode* next_codes;

  [[nodiscard]] const LaneBytes& cells() const { return masks[code / 2U]; }
  // Returns the next block. Both candidates are computed in advance, so only the choice between
  // them depends on `code`.
  [[nodiscard]] LaneBytes* next() const {
    LaneBytes* const by_u = block + strides.u;
    LaneBytes* const by_v = block + strides.v;
    return (code & 1U) != 0 ? by_v : by_u;
  }
  void step() {
    block = next();
    code = *next_codes;
    ++next_codes;
  }
  // Advances by `steps` blocks. `to` is the new block, which the caller has already located.
  void step_to(LaneBytes* to, std::uint32_t steps) {
    block = to;
    next_codes += steps;
    code = next_codes[-1];
  }
};

class BlockPath {
 public:
  // A line is monotone on each axis. The number of blocks that a line enters is therefore less than
  // the number of block columns plus the number of block rows. In grids with a longer side, no line
  // enters more blocks than that (car_block/limits.cpp). The search always stores two codes per
  // column of blocks, even if only one of them is valid.
  static constexpr std::size_t kMaxBlocks = std::size_t{2} * kBlocksPerSide;

  // Begins the path of a line that starts in the grid and meets no corner after its start
  // (traversal/corner.hpp).
  void begin(const vehicle::BeamLine& line, const BlockGrid& grid);

  // Returns the position relative to the first block's corner. Both axes point in the direction in
  // which the line runs.
  [[nodiscard]] traversal::Position from_corner(traversal::Position at) const {
    return {at.x + x_in_tile_ % kBlockSide, at.y + y_in_tile_ % kBlockSide};
  }

  // Returns how many block borders the line crosses before it reaches a position. The result is the
  // number of the block that contains the position.
  [[nodiscard]] std::uint32_t block_at(traversal::Position at) const {
    const traversal::Position corner = from_corner(at);
    return corner.x / kBlockSide + corner.y / kBlockSide;
  }

  // Returns the offset, in stored blocks, from the first block to the block that contains a
  // position. `corner` is the position's from_corner(). `strides` are those of way_from().
  [[nodiscard]] std::ptrdiff_t stride_to(traversal::Position corner, const Strides& strides) const {
    const auto [along_u, along_v] = strides;
    const auto x = static_cast<std::ptrdiff_t>(corner.x / kBlockSide);
    const auto y = static_cast<std::ptrdiff_t>(corner.y / kBlockSide);
    return orientation_.is_steep ? y * along_u + x * along_v : x * along_u + y * along_v;
  }

  // Extends the path up to this block, which must lie in the grid.
  void find_up_to(std::uint32_t block);

  // Returns the byte offset of the line's first cell.
  [[nodiscard]] std::uint32_t start_offset() const { return start_offset_; }

  [[nodiscard]] const Orientation& orientation() const { return orientation_; }

  [[nodiscard]] const BlockMasks& masks() const { return kBlockMasks[orientation_.number()]; }

  // Returns a mask that selects the cells of the first block, except those before the line's start.
  [[nodiscard]] Lanes start_mask() const { return Lanes::load_bytes(start_mask_.data()); }

  // Returns a cursor at the first block. `start` is the block at start_offset(). `strides` are
  // those of the grid's blocks.
  [[nodiscard]] Way way_from(LaneBytes* start, const Strides& strides) const {
    return {masks().of_shape.data(), strides, start, codes_[0], &codes_[1]};
  }

  // Calls visit(tile) at least once for each tile that the line enters up to this position.
  // `strides` are those of the grid's tiles. The height of the line at each border between two
  // columns of tiles shows whether the line has entered another row of tiles. This happens at most
  // once per column, because the slope is at most 1.
  template <typename Visit>
  void for_each_tile(traversal::Position last, const Strides& strides, Visit&& visit) const {
    const std::uint32_t columns_x = (last.x + x_in_tile_) / geometry::kTileSide;
    const std::uint32_t columns_y = (last.y + y_in_tile_) / geometry::kTileSide;
    std::uint32_t columns = orientation_.is_steep ? columns_y : columns_x;
    const auto [along_u, along_v] = strides;
    auto tile = std::ptrdiff_t{start_tile_};
    const auto last_tile = tile + static_cast<std::ptrdiff_t>(columns) * along_u +
                           static_cast<std::ptrdiff_t>(columns_x + columns_y - columns) * along_v;
    visit(static_cast<std::size_t>(tile));
    if (columns > 0) {
      const auto rise_to = [&, along_v = along_v](bool rises) {
        tile += rises ? along_v : 0;
        visit(static_cast<std::size_t>(tile));
      };
      const std::uint32_t step = step_;
      std::uint32_t height = tile_height_;
      rise_to(leaves_first_above_);
      for (tile += along_u; --columns > 0; tile += along_u) {
        visit(static_cast<std::size_t>(tile));
        height += step;
        rise_to(height < step);
      }
      visit(static_cast<std::size_t>(tile));
    }
    visit(static_cast<std::size_t>(last_tile));
  }

 private:
  void find_first_column(const vehicle::BeamLine& line);
  void skip_cell_above(std::uint32_t u, std::uint32_t v);

  // The members are declared in the order in which they are accessed and without padding, because
  // the paths of many lines are cached.
  std::array<std::int8_t, kLaneCount> start_mask_{};
  std::uint32_t start_offset_ = 0;
  // The height at which the line leaves the first column of tiles, in units of 2^-32 of a tile.
  // `leaves_first_above_` is true if this height is above the first tile.
  std::uint32_t tile_height_ = 0;
  // The state from which the search resumes: the phase at the next column of blocks
  // (traversal::Dda), its increment, and the row `v` within the block.
  std::uint32_t phase_ = 0;
  std::uint32_t step_ = 0;
  std::uint16_t start_tile_ = 0;
  std::uint16_t count_ = 0;
  std::uint8_t v_ = 0;
  bool leaves_first_above_ = false;
  Orientation orientation_;
  std::uint8_t x_in_tile_ = 0;  // offset of the line's start in its tile, in the line's direction
  std::uint8_t y_in_tile_ = 0;
  std::array<BlockCode, kMaxBlocks + 1> codes_{};
};

}  // namespace iog::grid
