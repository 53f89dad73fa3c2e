// Defines the grid, the numbering of its cells and tiles, and the vehicle's position in the grid
// (docs/model.md sections 5 and 8).
//
// Cells and tiles are numbered in row-major order from the lowest y.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/cell.hpp"
#include "geometry/sizes.hpp"
#include "geometry/tile.hpp"
#include "numeric/reciprocal.hpp"

namespace iog::geometry {

inline constexpr CellArea kGridArea{kCellsPerSide, kCellsPerSide};
inline constexpr std::size_t kCellCount = std::size_t{kCellsPerSide} * kCellsPerSide;

// `columns` is the number of cells per row.
[[nodiscard]] constexpr Cell cell_of(std::size_t number, std::size_t columns = kCellsPerSide) {
  return {static_cast<std::int32_t>(number % columns), static_cast<std::int32_t>(number / columns)};
}

[[nodiscard]] constexpr std::int32_t number_of(Cell cell, std::int32_t columns = kCellsPerSide) {
  return cell.y * columns + cell.x;
}

inline constexpr std::size_t kTilesPerSide = kCellsPerSide / kTileSide;
inline constexpr std::size_t kTileCount = kTilesPerSide * kTilesPerSide;
static_assert(kCellsPerSide % kTileSide == 0);
static_assert(kTileCount <= 0xFFFF, "the wire numbers tiles in 16 bits");

// Returns the tile that contains the cell. `across` is the number of tiles per row of the grid.
[[nodiscard]] constexpr std::size_t tile_of(Cell cell, std::size_t across = kTilesPerSide) {
  constexpr std::uint32_t kSide = kTileSide;
  const std::uint32_t tile_x = static_cast<std::uint32_t>(cell.x) / kSide;
  return static_cast<std::uint32_t>(cell.y) / kSide * across + tile_x;
}

// In the default grid, the vehicle frame's origin is at the centre of the grid, on a cell corner.
// In metres, cell (x, y) covers `[(x - 512) / 10, (x - 511) / 10)` along x. The same formula
// applies to y.
inline constexpr std::int32_t kOriginCell = kCellsPerSide / 2;

inline constexpr double kSubcellsPerMetre = 1000.0 / kCellMm * kResolution;

// The cell sizes that a car file may specify.
inline constexpr std::array<std::uint16_t, 4> kCellSizesMm{50, 100, 200, 500};
[[nodiscard]] constexpr bool is_cell_size(std::uint16_t mm) {
  return std::ranges::find(kCellSizesMm, mm) != kCellSizesMm.end();
}
// If a rule gives a distance or an area in cells, it assumes cells of this size.
inline constexpr std::uint16_t kUsualCellMm = 100;

// The maximum number of cells per side of a grid in a car file. Together, a column and a row fit
// into 24 bits.
inline constexpr std::int32_t kLongestSide = 4096;
static_assert(kCellsPerSide <= kLongestSide);

// The grid that a car file specifies. The memory has kCellCount cells. Cells and tiles are numbered
// in row-major order, with this grid's row length. A tile has the same number in memory and on the
// wire.
struct Grid {
  std::uint16_t cell_mm = kCellMm;
  std::uint16_t columns = kCellsPerSide;
  std::uint16_t rows = kCellsPerSide;
  // The vehicle frame's origin is the corner of this cell with the lowest x and y. `origin_column`
  // may equal `columns`, and `origin_row` may equal `rows`.
  std::uint16_t origin_column = kOriginCell;
  std::uint16_t origin_row = kOriginCell;

  [[nodiscard]] constexpr CellArea area() const { return {columns, rows}; }
  // Returns true if the grid differs from the default grid at most in its cell size.
  [[nodiscard]] constexpr bool is_whole() const { return Grid{.cell_mm = cell_mm} == *this; }
  // Converts a length to subcells, rounded down. The length must be below 2^21 mm.
  [[nodiscard]] constexpr std::int32_t subcells(std::int32_t mm) const {
    return mm * kResolution / cell_mm;
  }

  [[nodiscard]] constexpr std::size_t tiles_across() const { return columns / kTileSide; }
  [[nodiscard]] constexpr std::size_t tile_count() const {
    return tiles_across() * (rows / kTileSide);
  }
  // Returns true if the grid fits into the memory and the vehicle frame's origin is in the grid or
  // on its edge.
  [[nodiscard]] constexpr bool fits() const {
    return 0 < columns && columns <= kLongestSide && 0 < rows && rows <= kLongestSide &&
           columns % kTileSide == 0 && rows % kTileSide == 0 && tile_count() <= kTileCount &&
           origin_column <= columns && origin_row <= rows;
  }

  friend constexpr bool operator==(const Grid&, const Grid&) = default;
};

// Converts the tile numbers of a grid to columns and rows.
class TileRows {
 public:
  explicit constexpr TileRows(const Grid& grid = {})
      : across_(static_cast<std::uint32_t>(grid.tiles_across())), by_row_(across_) {}

  // Returns the number of tiles in a row.
  [[nodiscard]] constexpr std::uint32_t across() const { return across_; }
  // Returns the column and row of a tile, in tiles.
  [[nodiscard]] constexpr Cell place_of(std::size_t tile) const {
    const auto number = static_cast<std::uint32_t>(tile);
    const std::uint32_t row = by_row_.divide(number);
    return {static_cast<std::int32_t>(number - row * across_), static_cast<std::int32_t>(row)};
  }

 private:
  std::uint32_t across_;
  numeric::Reciprocal by_row_;
};

}  // namespace iog::geometry
