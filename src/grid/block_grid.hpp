// The grid of a frame, stored in blocks of 4 by 4 cells. Each block occupies sixteen bytes.
//
// On average, a line crosses four cells of a block, and a single saturating subtraction carves all
// of them (lanes/lanes.hpp). A cache line covers 8 by 4 cells. In a grid stored row by row, a cache
// line would cover 32 by 1 cells. Each row of blocks has one cache line of padding. Without this
// padding, all blocks of a column would compete for only two of the 256 sets of the L1 cache. The
// rows are as long as those of the car's grid.
//
// Outside src/grid, cells are numbered row by row (geometry/grid.hpp). A stored byte is an
// occupancy index or -128. Carving saturates at -128, and reading a cell converts -128 to -127.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "health/constants.hpp"
#include "index/occupancy_index.hpp"
#include "lanes/lanes.hpp"

namespace iog::grid {

using index::OccupancyIndex;
using lanes::kLaneCount;
using lanes::LaneBytes;
using lanes::Lanes;

inline constexpr std::int32_t kBlockSide = 4;
inline constexpr std::int32_t kBlocksPerSide = geometry::kCellsPerSide / kBlockSide;
inline constexpr std::int32_t kMostBlockRows = geometry::kLongestSide / kBlockSide;
inline constexpr std::int32_t kBlocksPerTile = geometry::kTileSide / kBlockSide;
static_assert(kLaneCount == std::size_t{kBlockSide} * kBlockSide);

// The number of stored blocks per row, including two blocks of padding (one cache line).
inline constexpr std::int32_t kBlockPadding = 2;
[[nodiscard]] constexpr std::int32_t block_stride_of(const geometry::Grid& grid) {
  return grid.columns / kBlockSide + kBlockPadding;
}
inline constexpr std::int32_t kBlockStride = block_stride_of({});

// Returns the byte offset of a cell. The cell's block begins at a multiple of 16.
[[nodiscard]] constexpr std::uint32_t offset_of(geometry::Cell cell, std::int32_t stride) {
  constexpr std::uint32_t kSide = kBlockSide;
  const auto x = static_cast<std::uint32_t>(cell.x);
  const auto y = static_cast<std::uint32_t>(cell.y);
  const std::uint32_t block = y / kSide * static_cast<std::uint32_t>(stride) + x / kSide;
  return block * kSide * kSide + y % kSide * kSide + x % kSide;
}

// The offsets from one element of an array to the next along a line's two axes u and v
// (block_shapes.hpp).
struct Strides {
  std::ptrdiff_t u = 0;
  std::ptrdiff_t v = 0;
};

class BlockGrid {
 public:
  explicit BlockGrid(const geometry::Grid& grid = {});

  // The strides of the stored blocks and of the tiles, for lines of one orientation.
  struct LineStrides {
    Strides blocks;
    Strides tiles;
  };
  // `orientation` is Orientation::number().
  [[nodiscard]] const LineStrides& strides(std::size_t orientation) const {
    return strides_[orientation];
  }
  // Returns the number of stored blocks per row, and the number of tiles per row.
  [[nodiscard]] std::int32_t stride() const { return stride_; }
  [[nodiscard]] std::uint32_t tiles_across() const { return tiles_.across(); }
  [[nodiscard]] const geometry::CellArea& area() const { return area_; }

  // Returns the block that contains the byte at this offset.
  [[nodiscard]] LaneBytes* block_at(std::uint32_t offset) { return &blocks_[offset / kLaneCount]; }

  // Returns the stored byte at this offset.
  [[nodiscard]] OccupancyIndex& cell_at(std::uint32_t offset) {
    return blocks_[offset / kLaneCount].bytes[offset % kLaneCount];
  }

  // The index of a cell.
  [[nodiscard]] OccupancyIndex at(geometry::Cell cell) const {
    const std::uint32_t offset = offset_of(cell, stride_);
    return index::raised(blocks_[offset / kLaneCount].bytes[offset % kLaneCount]);
  }

  // Marks this tile as touched: its cells may have changed since the tile was last cleared.
  void touch(std::size_t tile) { touched_[tile] = 1; }
  [[nodiscard]] bool is_touched(std::size_t tile) const { return touched_[tile] != 0; }

  // Copies all cells of the grid, row by row from the lowest y. The rest of `to` becomes unknown.
  void copy_cells(std::span<OccupancyIndex, geometry::kCellCount> to) const;
  // Copies the cells of the tile, row by row from the lowest y. Returns false if all cells of the
  // tile are unknown.
  bool copy_tile(std::size_t tile, std::span<OccupancyIndex, geometry::kTileCells> to) const;

  template <typename Visit>
  void for_each_constant(Visit&& visit) const {
    health::visit_constants(visit, tiles_, stride_, area_, strides_);
  }

  // Sets all cells of the tile to unknown and marks the tile as untouched.
  void clear_tile(std::size_t tile);

  // Returns the lowest row of the tile's blocks, which consists of kBlocksPerTile contiguous
  // blocks. The next row begins stride() blocks later.
  [[nodiscard]] const LaneBytes* blocks_of(std::size_t tile) const;

 private:
  static constexpr std::size_t kMostBlocks =
      geometry::kCellCount / kLaneCount + std::size_t{kMostBlockRows} * kBlockPadding;

  // Returns the index of the tile's first stored block.
  [[nodiscard]] std::size_t first_block(std::size_t tile) const;

  geometry::TileRows tiles_;
  std::int32_t stride_;
  geometry::CellArea area_;
  std::array<LineStrides, 8> strides_;
  std::array<std::uint8_t, geometry::kTileCount> touched_{};
  alignas(64) std::array<LaneBytes, kMostBlocks> blocks_{};
};

}  // namespace iog::grid
