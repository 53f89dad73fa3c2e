// Tiles: the squares of 32 by 32 cells in which a grid travels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "grid/block_grid.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::stream {

// Those of the grid, in bytes and numbers of the wire.
inline constexpr std::uint8_t kTileSideLog2 = 5;
inline constexpr std::size_t kTileSide = grid::kTileSide;
inline constexpr std::size_t kTileBytes = grid::kTileCells;
inline constexpr std::size_t kTilesPerSide = grid::kTilesPerSide;
inline constexpr std::size_t kTileCount = grid::kTileCount;
static_assert(kTileSide == std::size_t{1} << kTileSideLog2);
static_assert(kTileBytes == tile_coding::kTileBytes);
static_assert(kTileCount <= 0xFFFF, "the wire numbers tiles in 16 bits");

}  // namespace iog::stream
