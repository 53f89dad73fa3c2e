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
  static constexpr std::int32_t kSquaresBeside = 3;

  // The shape of the grid in cells and in tiles, and the length of a row of squares_ in bytes. Each
  // row has one extra byte before the grid's bytes and two after them.
  class Shape {
   public:
    explicit Shape(const geometry::Grid& grid = {}) : cells_(grid.area()) {}
    [[nodiscard]] geometry::CellArea cells() const { return cells_; }
    [[nodiscard]] geometry::CellArea tiles() const {
      return {cells_.width >> geometry::kTileSideLog2, cells_.height >> geometry::kTileSideLog2};
    }
    [[nodiscard]] std::int32_t square_stride() const { return tiles().width + kSquaresBeside; }

   private:
    geometry::CellArea cells_;
  };
  // The shape of the default grid, as constants. Lookups are faster with constants.
  struct UsualShape {
    static constexpr geometry::CellArea cells() { return geometry::kGridArea; }
    static constexpr geometry::CellArea tiles() {
      return {geometry::kTilesPerSide, geometry::kTilesPerSide};
    }
    static constexpr std::int32_t square_stride() { return tiles().width + kSquaresBeside; }
  };
  // Sets the shape. All cells must be unknown.
  void take_shape(const geometry::Grid& grid) {
    shape_ = Shape(grid);
    tile_rows_ = geometry::TileRows(grid);
  }
  [[nodiscard]] const Shape& shape() const { return shape_; }
  [[nodiscard]] const geometry::TileRows& tile_rows() const { return tile_rows_; }
  // Returns look(shape).
  template <typename Look>
  auto with_shape(Look&& look) const {
    const bool is_usual = shape_.cells().width == geometry::kGridArea.width &&
                          shape_.cells().height == geometry::kGridArea.height;
    return is_usual ? look(UsualShape{}) : look(shape_);
  }

  // Sets a tile of the grid. The indexes are stored row by row from the lowest y. Before the call,
  // the tile's cells must be unknown. `low_and_tall` contains the free cells that a low beam has
  // freed, and the hit cells that contain a tall return.
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
  [[nodiscard]] bool is_known(geometry::Cell tile) const {
    return is_known_[number_of(tile, shape_)];
  }

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
    geometry::Cell low{geometry::kTileCount, geometry::kTileCount};
    geometry::Cell high{-1, -1};
  };
  [[nodiscard]] const Extent& extent() const { return extent_; }

  // Returns true if any cell of a rectangle may be known. The rectangle may lie anywhere, but it
  // must have at most kMostNear columns and rows. `shape` is that of the grid.
  static constexpr std::int32_t kMostNear = 13;
  template <typename ItsShape>
  [[nodiscard]] bool is_known_near(geometry::Cell low, geometry::Cell high,
                                   const ItsShape& shape) const;
  [[nodiscard]] bool is_known_near(geometry::Cell low, geometry::Cell high) const {
    return is_known_near(low, high, shape_);
  }

  // Returns the cells of the tile in a column and row of the grid, row by row from the lowest y.
  // All cells are unknown if the tile is unknown or outside the grid. Callers may also read up to
  // kTileCells bytes after these cells, but those bytes are meaningless.
  template <typename ItsShape>
  [[nodiscard]] TileBytes cells(geometry::Cell tile, const ItsShape& shape) const {
    const std::size_t number = number_of(tile, shape);
    return shape.tiles().contains(tile) && is_known_[number] ? TileBytes(tiles_[places_[number]])
                                                             : TileBytes(kUnknown.front());
  }
  [[nodiscard]] TileBytes cells(geometry::Cell tile) const { return cells(tile, shape_); }
  // Returns the byte of any cell, inside or outside the grid.
  [[nodiscard]] std::int8_t at(geometry::Cell cell) const {
    constexpr std::uint32_t kSide = geometry::kTileSide;
    const TileBytes tile =
        cells({cell.x >> geometry::kTileSideLog2, cell.y >> geometry::kTileSideLog2});
    return tile[static_cast<std::uint32_t>(cell.y) % kSide * kSide +
                static_cast<std::uint32_t>(cell.x) % kSide];
  }

 private:
  // There is a second element because callers of cells() may read beyond the end of the first.
  using Bytes = std::array<std::int8_t, geometry::kTileCells>;
  alignas(32) static constexpr std::array<Bytes, 2> kUnknown{};

  // The width of the margin of unknown cells around the grid. If a rectangle passed to
  // is_known_near() overlaps the grid, it does not extend beyond this margin.
  static constexpr std::int32_t kAround = 16;
  static constexpr std::size_t kRowsAround = kAround / kSquareSide;
  // An upper bound for all grids.
  static constexpr std::size_t kMostSquareBytes =
      geometry::kTileCount * kSquaresOfTile +
      (geometry::kLongestSide / kSquareSide + 2 * kRowsAround) * kSquaresBeside +
      2 * kRowsAround * geometry::kLongestSide / geometry::kTileSide;

  template <typename ItsShape>
  [[nodiscard]] static std::size_t number_of(geometry::Cell tile, const ItsShape& shape) {
    return static_cast<std::uint32_t>(tile.y * shape.tiles().width + tile.x);
  }
  void forget_notes();
  void note(std::size_t tile);

  Shape shape_;
  geometry::TileRows tile_rows_;
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
  std::array<std::uint8_t, kMostSquareBytes> squares_{};
};

// Reads at most four rows of squares, and four squares in each row. Some of these squares may lie
// outside the grid, in the margin of squares_.
template <typename ItsShape>
inline bool SliceCells::is_known_near(geometry::Cell low, geometry::Cell high,
                                      const ItsShape& shape) const {
  constexpr std::int32_t kTile = geometry::kTileSide;
  if (low.x <= -kAround || low.y <= -kAround || low.x >= shape.cells().width ||
      low.y >= shape.cells().height) {
    return false;
  }
  const auto first = static_cast<std::uint32_t>(low.x + kTile) / kSquareSide;
  const auto last = static_cast<std::uint32_t>(high.x + kTile) / kSquareSide;
  const auto rows_end = static_cast<std::uint32_t>(high.y + kAround) / kSquareSide;
  const auto stride = static_cast<std::uint32_t>(shape.square_stride());
  std::uint32_t known = 0;
  for (auto row = static_cast<std::uint32_t>(low.y + kAround) / kSquareSide; row <= rows_end;
       ++row) {
    std::uint16_t bits = 0;
    const std::size_t place = std::size_t{row} * stride + first / kSquaresOfTile;
    __builtin_memcpy(&bits, &squares_[place], sizeof bits);
    known |= bits;
  }
  const std::uint32_t columns = (2U << (last - first)) - 1;
  return (known >> first % kSquaresOfTile & columns) != 0;
}

}  // namespace iog::placing
