// The slice grid is the index grid of a slice, stored by tiles with one byte per cell
// (placing/slice_byte.hpp). The slice grid also records which parts are known.
//
// The cells are a copy. Copying saves time because each cell is looked up four times on average.
// Known tiles are stored consecutively, so successive slices use the same part of the L2 cache. The
// cells of unknown tiles are not stored, so they do not have to be cleared.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/cell.hpp"
#include "geometry/grid.hpp"
#include "placing/slice_bytes.hpp"

namespace iog::placing {

class SliceCells {
 public:
  using TileIndexes = std::span<const std::int8_t, geometry::kTileCells>;
  using TileBytes = std::span<const std::int8_t, geometry::kTileCells>;

  // The number of rows in a band, and the side length of a block.
  static constexpr std::int32_t kBlockSide = 8;

  // Sets a tile of the grid. The indexes are stored row by row from the lowest y. Before the call,
  // the tile's cells must be unknown. `low_and_tall` contains the free cells that a low beam freed,
  // and the hit cells with a tall return.
  void set(std::size_t tile, TileIndexes indexes, const window::Plane& low_and_tall = {}) {
    places_[tile] = used_++;
    copy(tile, indexes, low_and_tall);
    note(tile);
  }

  // Sets all cells to unknown.
  void clear();

  // Replaces all tiles, using several cores. First call begin(). Then call copy() or leave() for
  // each tile, on any core. Finally call note_all(), on any core. If a core is lost, its tiles may
  // be set again.
  void begin();
  void copy(std::size_t tile, TileIndexes indexes, const window::Plane& low_and_tall = {});
  void leave(std::size_t tile) { is_known_[tile] = false; }
  void note_all();

  // Returns true if the tile has a known cell. The tile is given by its number or by its column and
  // row.
  [[nodiscard]] bool is_known(std::size_t tile) const { return is_known_[tile]; }
  [[nodiscard]] bool is_known(geometry::Cell tile) const { return is_known_[number_of(tile)]; }

  // Returns true if any cell in a band of a tile may be hit. A band has kBlockSide rows.
  [[nodiscard]] bool may_be_hit(std::size_t tile, std::size_t band) const {
    return (notes_[tile].hit_bands >> band & 1U) != 0;
  }

  // Returns the tiles that may contain a hit cell.
  [[nodiscard]] std::span<const std::uint16_t> hit_tiles() const {
    return std::span(hit_tiles_).first(hit_tile_count_);
  }

  // The bounds of all known tiles, in columns and rows.
  struct Extent {
    geometry::Cell low{geometry::kTilesPerSide, geometry::kTilesPerSide};
    geometry::Cell high{-1, -1};
  };
  [[nodiscard]] const Extent& extent() const { return extent_; }

  // `is_known_near()` returns true if any cell of a rectangle may be known. The rectangle may lie
  // anywhere, but it must have at most kMostNear columns and rows.
  static constexpr std::int32_t kMostNear = 13;
  [[nodiscard]] bool is_known_near(geometry::Cell low, geometry::Cell high) const;

  // Returns the cells of the tile in a column and row of the grid, row by row from the lowest y.
  // All cells are unknown if the tile is unknown or outside the grid. Callers may also read the
  // same number of bytes after these cells, but the values of these bytes are meaningless.
  [[nodiscard]] TileBytes cells(geometry::Cell tile) const {
    const std::size_t number = number_of(tile);
    return is_inside(tile) && is_known_[number] ? TileBytes(tiles_[places_[number]])
                                                : TileBytes(kUnknown.front());
  }
  // Returns the byte of any cell, inside or outside the grid.
  [[nodiscard]] std::int8_t at(geometry::Cell cell) const {
    constexpr std::uint32_t kSide = geometry::kTileSide;
    const TileBytes tile =
        cells({cell.x >> geometry::kTileSideLog2, cell.y >> geometry::kTileSideLog2});
    return tile[static_cast<std::uint32_t>(cell.y) % kSide * kSide +
                static_cast<std::uint32_t>(cell.x) % kSide];
  }

 private:
  // The second element allows callers of cells() to read beyond the end of the first element.
  using Bytes = std::array<std::int8_t, geometry::kTileCells>;
  alignas(32) static constexpr std::array<Bytes, 2> kUnknown{};

  // The width of the margin of unknown cells around the grid. A rectangle that is passed to
  // is_known_near() and overlaps the grid extends at most this far beyond the grid.
  static constexpr std::int32_t kAround = 16;
  static constexpr std::size_t kRowsAround = kAround / kSquareSide;
  static constexpr std::size_t kSquareRows =
      geometry::kCellsPerSide / kSquareSide + 2 * kRowsAround;
  // Each row has one extra byte before the grid's bytes and two after them.
  static constexpr std::size_t kSquareStride = geometry::kTilesPerSide + 3;

  [[nodiscard]] static constexpr std::size_t number_of(geometry::Cell tile) {
    return static_cast<std::uint32_t>(tile.y) * geometry::kTilesPerSide +
           static_cast<std::uint32_t>(tile.x);
  }
  [[nodiscard]] static constexpr bool is_inside(geometry::Cell tile) {
    return geometry::CellArea{geometry::kTilesPerSide, geometry::kTilesPerSide}.contains(tile);
  }
  void forget_notes();
  void note(std::size_t tile);
  void note_extent(std::size_t tile);
  void note_known(std::size_t tile);

  alignas(32) std::array<Bytes, geometry::kTileCount + 1> tiles_{};
  std::array<std::uint16_t, geometry::kTileCount> places_{};  // place of each known tile
  std::uint16_t used_ = 0;                                    // places used by set()
  std::array<bool, geometry::kTileCount> is_known_{};
  Extent extent_;
  std::array<TileNotes, geometry::kTileCount> notes_{};
  std::size_t hit_tile_count_ = 0;
  std::array<std::uint16_t, geometry::kTileCount> hit_tiles_{};
  // The known squares of the grid, surrounded by unknown squares. Each byte represents one row of
  // squares in a tile.
  std::array<std::uint8_t, kSquareRows * kSquareStride> squares_{};
};

// Reads at most four rows of squares, and four squares in each row. The squares at the corners may
// lie up to kAround cells outside the grid, where squares_ has a margin.
inline bool SliceCells::is_known_near(geometry::Cell low, geometry::Cell high) const {
  constexpr std::int32_t kSide = geometry::kCellsPerSide;
  constexpr std::int32_t kTile = geometry::kTileSide;
  if (low.x <= -kAround || low.y <= -kAround || low.x >= kSide || low.y >= kSide) {
    return false;
  }
  const auto first = static_cast<std::uint32_t>(low.x + kTile) / kSquareSide;
  const auto last = static_cast<std::uint32_t>(high.x + kTile) / kSquareSide;
  const auto rows_end = static_cast<std::uint32_t>(high.y + kAround) / kSquareSide;
  std::uint32_t known = 0;
  for (auto row = static_cast<std::uint32_t>(low.y + kAround) / kSquareSide; row <= rows_end;
       ++row) {
    std::uint16_t bits = 0;
    __builtin_memcpy(&bits, &squares_[row * kSquareStride + first / kSquaresOfTile], sizeof bits);
    known |= bits;
  }
  const std::uint32_t columns = (2U << (last - first)) - 1;
  return (known >> first % kSquaresOfTile & columns) != 0;
}

}  // namespace iog::placing
