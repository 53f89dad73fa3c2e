// The position of the window. The window is a rectangle of at most 32 by 32 tiles of the local
// frame.
//
// Cell (i, j) of the local frame covers [i, i + 1) x [j, j + 1) in units of the cell size. Tile (a,
// b) contains the cells with a = floor(i / 32) and b = floor(j / 32). The slot of tile (a, b) is
// `32 * (b mod 32) + a mod 32`. The slot does not depend on the position of the window, so no data
// is moved when the window moves. In messages, the tiles of a window with c columns and r rows are
// numbered `c * (b mod r) + a mod c`. If c and r are 32, this number is the slot. Coordinates of
// the local frame are int32 values in millimetres, so with cells of 0.1 m, tile numbers are within
// +-671,089. With cells of 0.2 m and 0.5 m, the range is smaller.
#pragma once

#include <cstddef>
#include <cstdint>

#include "geometry/cell.hpp"
#include "geometry/grid.hpp"
#include "numeric/division.hpp"
#include "pose/pose.hpp"

namespace iog::window {

inline constexpr std::int32_t kTileSide = geometry::kTileSide;
inline constexpr std::int32_t kTilesAcross = 32;
inline constexpr std::size_t kSlotCount = std::size_t{kTilesAcross} * kTilesAcross;
inline constexpr std::int32_t kCellsAcross = kTilesAcross * kTileSide;
inline constexpr geometry::CellArea kWindowCells{kCellsAcross, kCellsAcross};

// The column (a) and row (b) of a tile, counted from the origin of the local frame or from the
// corner of the window with the lowest coordinates.
struct TileNumber {
  std::int32_t a = 0;
  std::int32_t b = 0;
  friend constexpr bool operator==(const TileNumber&, const TileNumber&) = default;
};

// The size of a window in tiles, along the x and y axes of the local frame.
struct Extent {
  std::uint8_t columns = kTilesAcross;
  std::uint8_t rows = kTilesAcross;
  [[nodiscard]] constexpr std::size_t tile_count() const { return std::size_t{columns} * rows; }
  [[nodiscard]] constexpr geometry::CellArea cells() const {
    return {columns * kTileSide, rows * kTileSide};
  }
  // At least one tile must remain on each side of the car.
  [[nodiscard]] constexpr bool is_allowed() const {
    return columns >= 4 && columns <= kTilesAcross && rows >= 4 && rows <= kTilesAcross;
  }
  friend constexpr bool operator==(const Extent&, const Extent&) = default;
};

// Returns the tile of the local frame that contains a cell.
[[nodiscard]] constexpr TileNumber window_tile(geometry::Cell cell) {
  return {cell.x >> geometry::kTileSideLog2, cell.y >> geometry::kTileSideLog2};
}

[[nodiscard]] constexpr std::size_t slot_of(TileNumber tile) {
  constexpr std::uint32_t kMask = kTilesAcross - 1;
  return (static_cast<std::uint32_t>(tile.b) & kMask) * kTilesAcross +
         (static_cast<std::uint32_t>(tile.a) & kMask);
}

// Returns the cell of the local frame that contains a pose's origin.
[[nodiscard]] constexpr geometry::Cell cell_of(const pose::Pose& pose,
                                               std::int32_t cell_mm = geometry::kCellMm) {
  return {numeric::div_floor(pose.x_mm, cell_mm), numeric::div_floor(pose.y_mm, cell_mm)};
}

class Area {
 public:
  constexpr Area() = default;
  explicit constexpr Area(TileNumber corner, Extent extent = {})
      : corner_(corner), extent_(extent) {}

  // Returns the area that is centred as closely as possible on a cell.
  [[nodiscard]] static constexpr Area around(geometry::Cell cell, Extent extent = {}) {
    return Area({first_around(cell.x, extent.columns), first_around(cell.y, extent.rows)}, extent);
  }

  // Returns the area, moved if necessary to follow a cell. On each axis, the area moves if the cell
  // is more than one tile away from the middle. With 32 tiles and cells of 0.1 m, at least 48 m
  // therefore remain on each side, and noise at a tile border does not move the area.
  [[nodiscard]] constexpr Area following(geometry::Cell cell) const {
    const TileNumber centred = around(cell, extent_).corner_;
    return Area({is_near_middle(corner_.a, cell.x, extent_.columns) ? corner_.a : centred.a,
                 is_near_middle(corner_.b, cell.y, extent_.rows) ? corner_.b : centred.b},
                extent_);
  }

  // Returns the tile with the lowest a and b.
  [[nodiscard]] constexpr TileNumber corner() const { return corner_; }
  [[nodiscard]] constexpr Extent extent() const { return extent_; }

  [[nodiscard]] constexpr bool contains(TileNumber tile) const {
    return is_inside(tile.a - corner_.a, extent_.columns) &&
           is_inside(tile.b - corner_.b, extent_.rows);
  }
  [[nodiscard]] constexpr bool contains(geometry::Cell cell) const {
    return contains(window_tile(cell));
  }

  // Returns the tile at a slot. If the area has fewer than 32 by 32 tiles, the tile may be outside
  // the area. The tile number wraps around if it would exceed 32 bits.
  [[nodiscard]] constexpr TileNumber tile_at(std::size_t slot) const {
    constexpr std::uint32_t kMask = kTilesAcross - 1;
    const auto column = static_cast<std::uint32_t>(slot);
    const std::uint32_t row = column / kTilesAcross;
    return {plus(corner_.a, (column - static_cast<std::uint32_t>(corner_.a)) & kMask),
            plus(corner_.b, (row - static_cast<std::uint32_t>(corner_.b)) & kMask)};
  }

  // Calls visit(number, tile) for each tile of the area, in the order of their numbers in messages.
  template <typename Visit>
  constexpr void for_each_tile(Visit&& visit) const {
    const std::uint32_t a = remainder(corner_.a, extent_.columns);
    const std::uint32_t b = remainder(corner_.b, extent_.rows);
    std::size_t number = 0;
    for (std::uint32_t row = 0; row < extent_.rows; ++row) {
      const std::int32_t up = plus(corner_.b, row < b ? row + extent_.rows - b : row - b);
      for (std::uint32_t column = 0; column < extent_.columns; ++column) {
        const std::uint32_t right = column < a ? column + extent_.columns - a : column - a;
        visit(number++, TileNumber{plus(corner_.a, right), up});
      }
    }
  }

 private:
  static constexpr std::int32_t plus(std::int32_t first, std::uint32_t tiles) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(first) + tiles);
  }
  static constexpr std::uint32_t remainder(std::int32_t tile, std::int32_t across) {
    const std::int32_t rest = tile % across;
    return static_cast<std::uint32_t>(rest < 0 ? rest + across : rest);
  }
  static constexpr std::int32_t first_around(std::int32_t cell, std::int32_t across) {
    return numeric::div_floor(cell - (across - 1) * kTileSide / 2, kTileSide);
  }
  static constexpr bool is_near_middle(std::int32_t first, std::int32_t cell, std::int32_t across) {
    const std::int64_t from_middle =
        cell - std::int64_t{first} * kTileSide - across * kTileSide / 2;
    return from_middle >= -kTileSide && from_middle < kTileSide;
  }
  static constexpr bool is_inside(std::int32_t tiles, std::int32_t across) {
    return tiles >= 0 && tiles < across;
  }

  TileNumber corner_{};
  Extent extent_{};
};

}  // namespace iog::window
