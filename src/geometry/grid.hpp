// Defines the grid, the numbers of its cells and tiles, and the vehicle's position on it
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

// Returns the tile that contains a cell of a grid with this many tiles per row.
[[nodiscard]] constexpr std::size_t tile_of(Cell cell, std::size_t across = kTilesPerSide) {
  constexpr std::uint32_t kSide = kTileSide;
  const std::uint32_t tile_x = static_cast<std::uint32_t>(cell.x) / kSide;
  return static_cast<std::uint32_t>(cell.y) / kSide * across + tile_x;
}

// In the default grid, the vehicle frame's origin is the cell corner at the centre of the grid. In
// metres, cell (x, y) covers [(x - 512) / 10, (x - 511) / 10) along x. The formula for y is the
// same.
inline constexpr std::int32_t kOriginCell = kCellsPerSide / 2;

inline constexpr double kSubcellsPerMetre = 1000.0 / kCellMm * kResolution;

// The cell sizes that a car file may specify.
inline constexpr std::array<std::uint16_t, 4> kCellSizesMm{50, 100, 200, 500};
[[nodiscard]] constexpr bool is_cell_size(std::uint16_t mm) {
  return std::ranges::find(kCellSizesMm, mm) != kCellSizesMm.end();
}
// Rules that state a distance or an area in cells refer to cells of this size.
inline constexpr std::uint16_t kUsualCellMm = 100;

// The longest side of a grid that a car file may specify. A column and a row fit 24 bits together.
inline constexpr std::int32_t kLongestSide = 4096;
static_assert(kCellsPerSide <= kLongestSide);

// The grid that a car file specifies. The memory has kCellCount cells. Cells and tiles are numbered
// row by row in the grid's own rows. A tile has the same number in memory and on the wire.
struct Grid {
  std::uint16_t cell_mm = kCellMm;
  std::uint16_t columns = kCellsPerSide;
  std::uint16_t rows = kCellsPerSide;
  // The vehicle frame's origin is the lowest corner of this cell. Each of the two numbers may be
  // one past the last column or row.
  std::uint16_t origin_column = kOriginCell;
  std::uint16_t origin_row = kOriginCell;

  [[nodiscard]] constexpr CellArea area() const { return {columns, rows}; }
  // Returns true if the grid is as large as the memory and the car is in the middle.
  [[nodiscard]] constexpr bool is_whole() const { return Grid{.cell_mm = cell_mm} == *this; }
  // Converts a length to subcells, rounded down. The length must be below 2^21 mm.
  [[nodiscard]] constexpr std::int32_t subcells(std::int32_t mm) const {
    return mm * kResolution / cell_mm;
  }

  [[nodiscard]] constexpr std::size_t tiles_across() const { return columns / kTileSide; }
  [[nodiscard]] constexpr std::size_t tile_count() const {
    return tiles_across() * (rows / kTileSide);
  }
  // Returns true if the grid fits into the memory, and the vehicle's origin into the grid.
  [[nodiscard]] constexpr bool fits() const {
    return 0 < columns && columns <= kLongestSide && 0 < rows && rows <= kLongestSide &&
           columns % kTileSide == 0 && rows % kTileSide == 0 && tile_count() <= kTileCount &&
           origin_column <= columns && origin_row <= rows;
  }

  friend constexpr bool operator==(const Grid&, const Grid&) = default;
};

// The rows of a grid's tiles.
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
