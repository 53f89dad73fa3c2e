// The grid: its cells and tiles, their numbering, and the vehicle's position on the grid
// (docs/model.md sections 5 and 8).
//
// Cells and tiles are numbered in row-major order from the lowest y.
#pragma once

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

// The tile that contains a cell of the grid.
[[nodiscard]] constexpr std::size_t tile_of(Cell cell) {
  constexpr std::uint32_t kSide = kTileSide;
  const std::uint32_t tile_x = static_cast<std::uint32_t>(cell.x) / kSide;
  return static_cast<std::uint32_t>(cell.y) / kSide * kTilesPerSide + tile_x;
}

// The vehicle frame's origin is the corner at the centre of the grid. In metres, cell (x, y) of the
// default grid covers [(x - 512) / 10, (x - 511) / 10) along x. The formula for y is the same.
inline constexpr std::int32_t kOriginCell = kCellsPerSide / 2;

inline constexpr double kSubcellsPerMetre = 1000.0 / kCellMm * kResolution;

}  // namespace iog::geometry
