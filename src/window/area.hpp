// The position of the window. The window is a square of 32 by 32 tiles of the local frame.
//
// Cell (i, j) of the local frame covers [i, i + 1) x [j, j + 1) in units of the cell size. Tile (a,
// b) contains the cells for which i / 32 and j / 32, rounded down, are a and b. The slot of tile
// (a, b) is 32 (b mod 32) + a mod 32. The slot does not depend on the position of the window, so no
// data is moved when the window moves. Coordinates of the local frame are int32 millimetres. For
// cells of 0.1 m, tile numbers are therefore within +-671,089. For cells of 0.2 m and 0.5 m, tile
// numbers are closer to 0.
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

// A tile of the local frame, or a tile of the window counted from the window's lowest corner.
struct TileNumber {
  std::int32_t a = 0;
  std::int32_t b = 0;
  friend constexpr bool operator==(const TileNumber&, const TileNumber&) = default;
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
  explicit constexpr Area(TileNumber corner) : corner_(corner) {}

  // Returns the area that is centred on the tile corner nearest to a cell.
  [[nodiscard]] static constexpr Area around(geometry::Cell cell) {
    return Area({first_around(cell.x), first_around(cell.y)});
  }

  // Returns the area after it has followed a cell. The area has a one-tile square in its middle. On
  // each axis, the area moves if the cell is more than half a tile outside the middle square. With
  // cells of 0.1 m, at least 48 m therefore remain on each side, and noise at a tile border does
  // not move the area.
  [[nodiscard]] constexpr Area following(geometry::Cell cell) const {
    const TileNumber centred = around(cell).corner_;
    return Area({is_near_middle(corner_.a, cell.x) ? corner_.a : centred.a,
                 is_near_middle(corner_.b, cell.y) ? corner_.b : centred.b});
  }

  // Returns the tile with the lowest a and b.
  [[nodiscard]] constexpr TileNumber corner() const { return corner_; }

  [[nodiscard]] constexpr bool contains(TileNumber tile) const {
    return is_inside(tile.a - corner_.a) && is_inside(tile.b - corner_.b);
  }
  [[nodiscard]] constexpr bool contains(geometry::Cell cell) const {
    return contains(window_tile(cell));
  }

  // Returns the tile of the area at a slot. The tile number wraps around if the area would exceed
  // 32 bits.
  [[nodiscard]] constexpr TileNumber tile_at(std::size_t slot) const {
    constexpr std::uint32_t kMask = kTilesAcross - 1;
    const auto column = static_cast<std::uint32_t>(slot);
    const std::uint32_t row = column / kTilesAcross;
    const std::uint32_t right = (column - static_cast<std::uint32_t>(corner_.a)) & kMask;
    const std::uint32_t up = (row - static_cast<std::uint32_t>(corner_.b)) & kMask;
    return {static_cast<std::int32_t>(static_cast<std::uint32_t>(corner_.a) + right),
            static_cast<std::int32_t>(static_cast<std::uint32_t>(corner_.b) + up)};
  }

 private:
  static constexpr std::int32_t kHalf = kTilesAcross / 2;

  static constexpr std::int32_t first_around(std::int32_t cell) {
    return numeric::div_floor(cell + kTileSide / 2, kTileSide) - kHalf;
  }
  static constexpr bool is_near_middle(std::int32_t first, std::int32_t cell) {
    const std::int64_t from_middle = cell - std::int64_t{first + kHalf} * kTileSide;
    return from_middle >= -kTileSide && from_middle < kTileSide;
  }
  static constexpr bool is_inside(std::int32_t tiles) { return tiles >= 0 && tiles < kTilesAcross; }

  TileNumber corner_{};
};

}  // namespace iog::window
