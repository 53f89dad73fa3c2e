// The blocks that a line goes through, in order: one byte each, found once and kept.
//
// Blocks of a line are numbered from 0, which holds its start. As the line meets no corner, each
// block borders on the one before, and a block's number is the number of block borders that lie
// between it and the first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "grid/block_shapes.hpp"
#include "vehicle/grid_geometry.hpp"

namespace iog::grid {

// Where a cell of a line lies: its offset in the grid, and the number of its block.
struct Place {
  std::uint32_t offset = 0;
  std::uint32_t block = 0;
};

// Blocks of a line one after the other: the next is u_stride or v_stride blocks (as stored) further,
// as its code says, and the cells of the line in it are masks[code / 2].
struct BlockRun {
  const BlockCode* code;
  const LaneBytes* masks;
  std::ptrdiff_t u_stride;
  std::ptrdiff_t v_stride;
};

class BlockPath {
 public:
  // Of a line that begins in the grid and meets no corner (traversal/steady_walk.hpp).
  void begin(const vehicle::BeamLine& line);

  // The place of a cell of the line that lies in the grid.
  [[nodiscard]] Place place_of(traversal::Cell cell) const {
    const auto distance = [](std::int32_t a, std::int32_t b) { return a < b ? b - a : a - b; };
    return {offset_of(cell), static_cast<std::uint32_t>(distance(cell.x / kBlockSide, start_x_) +
                                                        distance(cell.y / kBlockSide, start_y_))};
  }

  // Finds the blocks up to this one, which lies in the grid.
  void extend_to(std::uint32_t block) {
    if (block >= count_) {
      find_up_to(block);
    }
  }

  // The rest is about blocks that were found. The cells of the line in a block:
  [[nodiscard]] const LaneBytes& cells(std::uint32_t block) const {
    return block == 0 ? first_cells_ : (*masks_)[codes_[block] / 2U];
  }
  [[nodiscard]] const Orientation& orientation() const { return orientation_; }

  // Two lines from one start that go through the same cells of their first blocks, so many.
  [[nodiscard]] std::uint32_t count_common(const BlockPath& other, std::uint32_t at_most) const;

  // The way through the blocks from this one on.
  [[nodiscard]] BlockRun run_from(std::uint32_t block) const {
    return {&codes_[block], masks_->data(), u_stride_, v_stride_};
  }

  // Shows the tiles of the blocks up to this one to `visit`, by number.
  template <typename Visit>
  void for_each_tile(std::uint32_t last_block, Visit&& visit) const {
    for (std::size_t i = 0; i < tile_count_ && tiles_[i].first_block <= last_block; ++i) {
      visit(std::size_t{tiles_[i].number});
    }
  }

 private:
  struct Tile {
    std::uint16_t first_block = 0;
    std::uint16_t number = 0;
  };

  // A line runs one way on each axis, so it enters at most as many blocks and tiles as both have.
  static constexpr std::size_t kMaxBlocks = 2 * kBlocksPerSide;
  static constexpr std::size_t kMaxTiles = 2 * kTilesPerSide;

  void find_first_block(traversal::Cell start);
  void find_up_to(std::uint32_t block);
  void leave(std::int32_t& coordinate, std::int32_t step);
  void note_tile();

  const ShapeMasks* masks_ = nullptr;
  Orientation orientation_;
  std::int32_t start_x_ = 0;  // the first block
  std::int32_t start_y_ = 0;
  std::int32_t u_stride_ = 0;  // from a block to the next, in blocks as stored
  std::int32_t v_stride_ = 0;
  LaneBytes first_cells_;

  // The way on from the last block that was found. The error term is that of traversal/walk.hpp,
  // with u for columns: a border of u comes next if it is below 0.
  std::int32_t x_ = 0;
  std::int32_t y_ = 0;
  std::int32_t error_ = 0;
  std::int32_t gain_ = 0;
  std::int32_t loss_ = 0;
  BlockEntry entry_ = 0;
  std::uint32_t count_ = 0;
  std::uint32_t tile_count_ = 0;

  std::array<BlockCode, kMaxBlocks> codes_{};
  std::array<Tile, kMaxTiles> tiles_{};
};

}  // namespace iog::grid
