// The cells of a tile, as they travel: 32 by 32 occupancy indexes, int8, row by row from the lowest
// y.
#pragma once

#include <cstddef>
#include <span>

namespace iog::tile_coding {

inline constexpr std::size_t kTileSideLog2 = 5;
inline constexpr std::size_t kTileSide = std::size_t{1} << kTileSideLog2;
inline constexpr std::size_t kTileBytes = kTileSide * kTileSide;

// An index is -127 to +127; the byte of -128 never occurs.
inline constexpr std::byte kNoIndex{0x80};

using TileCells = std::span<const std::byte, kTileBytes>;
using MutableTileCells = std::span<std::byte, kTileBytes>;

}  // namespace iog::tile_coding
