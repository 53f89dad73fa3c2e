// Tiles: the squares of 32 by 32 cells in which a grid travels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "grid/block_grid.hpp"
#include "stream/crc32.hpp"
#include "stream/message.hpp"

namespace iog::stream {

inline constexpr std::uint8_t kTileSideLog2 = 5;
inline constexpr std::size_t kTileSide = std::size_t{1} << kTileSideLog2;
inline constexpr std::size_t kTileBytes = kTileSide * kTileSide;
inline constexpr std::size_t kTilesPerSide = vehicle::kCellsPerSide / kTileSide;
inline constexpr std::size_t kTileCount = kTilesPerSide * kTilesPerSide;
static_assert(kTileSide == grid::kTileSide && kTileCount == grid::kTileCount);
static_assert(kHeaderBytes + kTileHeaderBytes + kTileBytes <= kMaxMessageBytes);

// The name of a grid: CRC-32 over its known tiles in order of tile y, then tile x, each as u16 tile
// x and u16 tile y, big endian, then its 1024 cells. A grid in which nothing is known has CRC 0.
class GridHash {
 public:
  void add(std::size_t tile_x, std::size_t tile_y, std::span<const std::byte, kTileBytes> tile);
  [[nodiscard]] std::uint32_t value() const { return crc_.value(); }

 private:
  Crc32 crc_;
};

// A header for tile (x, y) of the grid, raw.
[[nodiscard]] TileHeader raw_tile_header(std::size_t tile_x, std::size_t tile_y);

}  // namespace iog::stream
