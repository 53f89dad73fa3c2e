// The index grid of a slice row by row, a byte a cell (window/slice_byte.hpp), so that a cell is
// found by one multiplication, and where something is known in it at all.
//
// It is a copy: a slice's cells are looked up four times as often as they are copied. Rows are
// stored two cache lines longer than they are, otherwise the cells of a column would compete for a
// few sets of a level 1 cache.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/cell.hpp"
#include "geometry/grid.hpp"
#include "window/slice_byte.hpp"

namespace iog::window {

class SliceCells {
 public:
  using TileIndexes = std::span<const std::int8_t, geometry::kTileCells>;

  static constexpr std::size_t kStride = geometry::kCellsPerSide + 64;

  // Tiles are looked at in bands of so many rows, and in blocks of so many cells and rows.
  static constexpr std::int32_t kBlockSide = 8;

  // Sets a tile of a grid, row by row from its lowest y. Before, all of its cells are
  // unknown.
  // low_and_tall: which of its cells that are free were freed from below, and which of those that
  // are hit are tall.
  void set(std::size_t tile, TileIndexes indexes, const Plane& low_and_tall = {}) {
    copy(tile, indexes, low_and_tall);
    note(tile);
  }
  // The two steps of it: several cores may copy tiles at the same time, and copy one again; then
  // each is noted once.
  void copy(std::size_t tile, TileIndexes indexes, const Plane& low_and_tall = {});
  void note(std::size_t tile);

  // All cells are unknown again.
  void clear();

  // The same of a slice of which every tile is said anew: first begin(), then copy() or leave() of
  // each tile by any core, and again if one is lost, then note_all().
  void begin();
  void leave(std::size_t tile);
  void note_all();

  // Whether something is known in a tile of the grid, by number, or by column and row.
  [[nodiscard]] bool is_known(std::size_t tile) const { return is_known_[tile]; }
  [[nodiscard]] bool is_known(geometry::Cell tile) const {
    return is_known_[static_cast<std::uint32_t>(tile.y) * geometry::kTilesPerSide +
                     static_cast<std::uint32_t>(tile.x)];
  }

  // Whether a cell of a tile may be hit, in the band of kBlockSide rows of this number.
  [[nodiscard]] bool may_be_hit(std::size_t tile, std::size_t band) const {
    return (hit_bands_[tile] >> band & 1U) != 0;
  }

  // The tiles in which a cell may be hit.
  [[nodiscard]] std::span<const std::uint16_t> hit_tiles() const {
    return std::span(hit_tiles_).first(hit_tile_count_);
  }

  // The tiles of the grid between which all are in which something is known, by column and row.
  struct Extent {
    geometry::Cell low{geometry::kTilesPerSide, geometry::kTilesPerSide};
    geometry::Cell high{-1, -1};
  };
  [[nodiscard]] const Extent& extent() const { return extent_; }

  // Whether something may be known in the square of 2 kBlockSide + 1 cells above and to the right
  // of a cell of the grid, itself included.
  [[nodiscard]] bool is_known_near(geometry::Cell low) const {
    const auto x = static_cast<std::uint32_t>(low.x) / kBlockSide;
    const auto y = static_cast<std::uint32_t>(low.y) / kBlockSide;
    return is_near_[(y + kBlocksBefore) * kNearStride + x + kBlocksBefore] != 0;
  }

  // A byte for each of the grid's cells (window/slice_byte.hpp), kStride from one row to the next.
  [[nodiscard]] const std::int8_t* cells() const { return cells_.data(); }

  // The first cell of a tile.
  [[nodiscard]] static constexpr std::size_t first_of(std::size_t tile) {
    return tile / geometry::kTilesPerSide * geometry::kTileSide * kStride +
           tile % geometry::kTilesPerSide * geometry::kTileSide;
  }

 private:
  static constexpr std::size_t kBlocksAcross = geometry::kCellsPerSide / kBlockSide;
  static constexpr std::size_t kBlocksBefore = 2;
  static constexpr std::size_t kNearStride = kBlocksAcross + kBlocksBefore;

  static constexpr std::size_t kBlocksOfTile = geometry::kTileSide / kBlockSide;
  static_assert(kBlocksOfTile * kBlocksOfTile == 16);

  void note_extent(std::size_t tile);
  void note_known(std::size_t tile);

  alignas(32) std::array<std::int8_t, geometry::kCellsPerSide * kStride> cells_{};
  std::array<bool, geometry::kTileCount> is_known_{};
  Extent extent_;
  std::array<std::uint8_t, geometry::kTileCount> hit_bands_{};  // bit i: band i
  // Bit 4 y + x: whether something is known in the block x, y of the tile.
  std::array<std::uint16_t, geometry::kTileCount> known_blocks_{};
  std::size_t hit_tile_count_ = 0;
  std::array<std::uint16_t, geometry::kTileCount> hit_tiles_{};
  // By block: whether something is known in it, or in one of the eight above and to the right.
  // Blocks of the grid begin at (2, 2): the first two rows and columns are of blocks outside. Eight
  // are written at once, the last of them behind the last row.
  alignas(8) std::array<std::int8_t, kNearStride * kNearStride + kBlocksBefore> is_near_{};
};

}  // namespace iog::window
