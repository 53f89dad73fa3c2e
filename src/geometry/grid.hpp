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

namespace iog::geometry {

inline constexpr CellArea kGridArea{kCellsPerSide, kCellsPerSide};
inline constexpr std::size_t kCellCount = std::size_t{kCellsPerSide} * kCellsPerSide;

[[nodiscard]] constexpr Cell cell_of(std::size_t number) {
  constexpr std::size_t kRow = kCellsPerSide;
  return {static_cast<std::int32_t>(number % kRow), static_cast<std::int32_t>(number / kRow)};
}

[[nodiscard]] constexpr std::int32_t number_of(Cell cell) {
  return cell.y * kCellsPerSide + cell.x;
}

inline constexpr std::size_t kTilesPerSide = kCellsPerSide / kTileSide;
inline constexpr std::size_t kTileCount = kTilesPerSide * kTilesPerSide;
static_assert(kCellsPerSide % kTileSide == 0);
static_assert(kTileCount <= 0xFFFF, "the wire numbers tiles in 16 bits");

// Returns the tile that contains a cell of the grid.
[[nodiscard]] constexpr std::size_t tile_of(Cell cell) {
  constexpr std::uint32_t kSide = kTileSide;
  const std::uint32_t tile_x = static_cast<std::uint32_t>(cell.x) / kSide;
  return static_cast<std::uint32_t>(cell.y) / kSide * kTilesPerSide + tile_x;
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

// The grid that a car file specifies. The memory always has kCellsPerSide cells per row, so the
// numbers of cells and tiles above do not depend on the car file. A smaller grid occupies the part
// of the memory that starts at cell (0, 0).
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

  [[nodiscard]] constexpr std::size_t tile_count() const {
    return columns / kTileSide * (rows / kTileSide);
  }
  // Counts the grid's tiles that precede this tile of the memory in row-major order. If the tile is
  // part of the grid, the result is the tile number on the wire.
  [[nodiscard]] constexpr std::size_t tiles_before(std::size_t tile) const {
    const std::size_t across = columns / kTileSide;
    const std::size_t up = rows / kTileSide;
    const std::size_t row = tile / kTilesPerSide;
    const std::size_t column = tile % kTilesPerSide;
    return row < up ? row * across + (column < across ? column : across) : up * across;
  }
  // Returns the tile of the memory that has this number on the wire.
  [[nodiscard]] constexpr std::size_t tile_in_memory(std::size_t number) const {
    const std::size_t across = columns / kTileSide;
    return number / across * kTilesPerSide + number % across;
  }

  friend constexpr bool operator==(const Grid&, const Grid&) = default;
};

}  // namespace iog::geometry
