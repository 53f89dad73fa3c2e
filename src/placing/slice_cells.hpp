// The index grid of a slice tile by tile, a byte a cell (placing/slice_byte.hpp), and where
// something is known in it at all.
//
// It is a copy, because its cells are looked up four times as often as they are copied. The tiles
// in which something is known lie one after the other, so that those of slice after slice take the
// same part of the level 2 cache. The others have no cells, and need not be cleared.
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

  // Tiles are looked at in bands of so many rows, and in blocks of so many cells and rows.
  static constexpr std::int32_t kBlockSide = 8;

  // Sets a tile of a grid, row by row from its lowest y. Before, all of its cells are
  // unknown.
  // low_and_tall: which of its cells that are free were freed from below, and which of those that
  // are hit are tall.
  void set(std::size_t tile, TileIndexes indexes, const window::Plane& low_and_tall = {}) {
    places_[tile] = used_++;
    copy(tile, indexes, low_and_tall);
    note(tile);
  }

  // All cells are unknown again.
  void clear();

  // The same of a slice of which every tile is said anew: first begin(), then copy() or leave() of
  // each tile by any core, and again if one is lost, then note_all(), by any core, too.
  void begin();
  void copy(std::size_t tile, TileIndexes indexes, const window::Plane& low_and_tall = {});
  void leave(std::size_t tile) { is_known_[tile] = false; }
  void note_all();

  // Whether something is known in a tile of the grid, by number, or by column and row.
  [[nodiscard]] bool is_known(std::size_t tile) const { return is_known_[tile]; }
  [[nodiscard]] bool is_known(geometry::Cell tile) const { return is_known_[number_of(tile)]; }

  // Whether a cell of a tile may be hit, in the band of kBlockSide rows of this number.
  [[nodiscard]] bool may_be_hit(std::size_t tile, std::size_t band) const {
    return (notes_[tile].hit_bands >> band & 1U) != 0;
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

  // Whether something may be known in a rectangle, from its lowest cell to its highest. It may lie
  // anywhere, and has at most kMostNear cells and rows.
  static constexpr std::int32_t kMostNear = 13;
  [[nodiscard]] bool is_known_near(geometry::Cell low, geometry::Cell high) const;

  // The cells of a tile by its column and row, row by row from its lowest y. All of them are
  // unknown of one that has none, or lies outside of the grid. As many bytes again may be read
  // behind them, and mean nothing.
  [[nodiscard]] TileBytes cells(geometry::Cell tile) const {
    const std::size_t number = number_of(tile);
    return is_inside(tile) && is_known_[number] ? TileBytes(tiles_[places_[number]])
                                                : TileBytes(kUnknown.front());
  }
  // Any cell.
  [[nodiscard]] std::int8_t at(geometry::Cell cell) const {
    constexpr std::uint32_t kSide = geometry::kTileSide;
    const TileBytes tile =
        cells({cell.x >> geometry::kTileSideLog2, cell.y >> geometry::kTileSideLog2});
    return tile[static_cast<std::uint32_t>(cell.y) % kSide * kSide +
                static_cast<std::uint32_t>(cell.x) % kSide];
  }

 private:
  // Behind the last one there is room for who reads on.
  using Bytes = std::array<std::int8_t, geometry::kTileCells>;
  alignas(32) static constexpr std::array<Bytes, 2> kUnknown{};

  // Squares outside of the grid lie around it, as far as a rectangle reaches that has one of its
  // own.
  static constexpr std::int32_t kAround = 16;
  static constexpr std::size_t kRowsAround = kAround / kSquareSide;
  static constexpr std::size_t kSquareRows =
      geometry::kCellsPerSide / kSquareSide + 2 * kRowsAround;
  static constexpr std::size_t kSquareStride =
      geometry::kTilesPerSide + 3;  // one before, two behind

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
  std::array<std::uint16_t, geometry::kTileCount> places_{};  // where a known tile lies
  std::uint16_t used_ = 0;                                    // places, by set()
  std::array<bool, geometry::kTileCount> is_known_{};
  Extent extent_;
  std::array<TileNotes, geometry::kTileCount> notes_{};
  std::size_t hit_tile_count_ = 0;
  std::array<std::uint16_t, geometry::kTileCount> hit_tiles_{};
  // The same of the grid, with unknown squares around it; a byte a tile.
  std::array<std::uint8_t, kSquareRows * kSquareStride> squares_{};
};

// At most four rows of squares, and four squares of each. Those that hold the corners may lie
// outside of the grid by kAround cells, and there are some.
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
