// The blocks that a line goes through, in order: one byte each, found once and kept.
//
// The blocks of a line are numbered from 0, which holds its start. As the line meets no corner,
// each block shares a border with the one before. So the number of a block is the number of block
// borders between it and the first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "grid/block_shapes.hpp"
#include "vehicle/beam_line.hpp"

namespace iog::grid {

// Blocks of a line, one after the other. The code of a block says whether the next one lies
// u_stride or v_stride blocks (as stored) further. The line's cells in a block are masks[code / 2].
struct BlockRun {
  const BlockCode* code;
  const LaneBytes* masks;
  std::ptrdiff_t u_stride;
  std::ptrdiff_t v_stride;
};

class BlockPath {
 public:
  // Begins the path of a line that starts in the grid and meets no corner (traversal/corner.hpp).
  void begin(const vehicle::BeamLine& line);

  // The offset in the grid of the cell at a position of the line.
  [[nodiscard]] std::uint32_t offset_at(traversal::Position at) const {
    return offset_of(cell_at(at));
  }

  // The number of the block in which a position lies: the block borders crossed to get there.
  [[nodiscard]] std::uint32_t block_at(traversal::Position at) const {
    return (at.x + x_in_block_) / kBlockSide + (at.y + y_in_block_) / kBlockSide;
  }

  // Finds the blocks up to this one, which lies in the grid.
  void extend_to(std::uint32_t block) {
    if (block >= count_) {
      find_up_to(block);
    }
  }

  // Where the line begins.
  [[nodiscard]] std::uint32_t start_offset() const { return offset_of(start_); }

  // The rest is about blocks that were found. The line's cells in a block:
  [[nodiscard]] const LaneBytes& cells(std::uint32_t block) const {
    if (block == 0) {
      return first_cells_;
    }
    return (*masks_)[codes_[block] / 2U];
  }
  [[nodiscard]] const Orientation& orientation() const { return orientation_; }

  // The way through the blocks from this one on.
  [[nodiscard]] BlockRun run_from(std::uint32_t block) const {
    return {&codes_[block], masks_->data(), u_stride_, v_stride_};
  }

  // Calls visit(tile) for each tile of the blocks up to this one.
  template <typename Visit>
  void for_each_tile(std::uint32_t last_block, Visit&& visit) const {
    auto tile = static_cast<std::int32_t>(geometry::tile_of(start_));
    const TileEntry* entry = tile_entries_.data();
    for (; *entry / 2U <= last_block; ++entry) {
      visit(static_cast<std::size_t>(tile));
      tile += (entry[1] & 1U) != 0 ? tile_along_y_ : tile_along_x_;
    }
  }

 private:
  // Twice the number of the block with which a line enters a tile, and 1 more if it comes from the
  // tile below or above.
  using TileEntry = std::uint16_t;
  static constexpr TileEntry kNoTile = 0xFFFF;

  // A line runs one way on each axis. So it enters at most as many blocks, and tiles, as both axes
  // have together.
  static constexpr std::size_t kMaxBlocks = std::size_t{2} * kBlocksPerSide;
  static constexpr std::size_t kMaxTiles = std::size_t{2} * geometry::kTilesPerSide;
  static_assert(2 * kMaxBlocks < kNoTile);

  [[nodiscard]] geometry::Cell cell_at(traversal::Position at) const {
    const auto x = static_cast<std::int32_t>(at.x);
    const auto y = static_cast<std::int32_t>(at.y);
    return {orientation_.x_is_negative ? start_.x - x : start_.x + x,
            orientation_.y_is_negative ? start_.y - y : start_.y + y};
  }

  void find_first_block();
  void find_up_to(std::uint32_t block);
  void note_tile(std::uint32_t first_block, bool along_y);

  geometry::Cell start_;
  std::uint8_t x_in_block_ = 0;  // how far into its block the line begins, in its own direction
  std::uint8_t y_in_block_ = 0;
  Orientation orientation_;
  std::int16_t tile_along_x_ = 0;  // from a tile to the next, by number
  std::int16_t tile_along_y_ = 0;
  const ShapeMasks* masks_ = nullptr;
  std::int16_t u_stride_ = 0;  // from a block to the next, in blocks as stored
  std::int16_t v_stride_ = 0;
  std::uint32_t count_ = 0;
  LaneBytes first_cells_;
  std::array<BlockCode, kMaxBlocks> codes_{};
  std::array<TileEntry, kMaxTiles + 1> tile_entries_{};

  // Where the search goes on after the last block that was found. The error term is that of
  // traversal/walk.hpp with u for columns: below 0, a border of u comes next.
  std::int32_t error_ = 0;
  std::int32_t gain_ = 0;
  std::int32_t loss_ = 0;
  BlockEntry entry_ = 0;
  // Block borders along each axis, up to and including the tile's.
  std::uint32_t blocks_to_tile_u_ = 0;
  std::uint32_t blocks_to_tile_v_ = 0;
  std::uint32_t tile_count_ = 0;
};

}  // namespace iog::grid
