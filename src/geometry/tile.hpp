// Tiles are squares of cells. Grids are stored, encoded and sent tile by tile.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::geometry {

inline constexpr std::uint32_t kTileSideLog2 = 5;
inline constexpr std::size_t kTileSide = std::size_t{1} << kTileSideLog2;
inline constexpr std::size_t kTileCells = kTileSide * kTileSide;

}  // namespace iog::geometry
