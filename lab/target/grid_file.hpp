// A grid as `iog fuse --out-raw` writes it, read through semihosting, and its tiles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdio>
#include <span>

#include "tile_coding/tile_cells.hpp"

namespace iog::lab {

inline constexpr std::size_t kGridSide = 1024;
inline constexpr std::size_t kTilesPerSide = kGridSide / tile_coding::kTileSide;

using Grid = std::array<std::byte, kGridSide * kGridSide>;
using Tile = std::array<std::byte, tile_coding::kTileBytes>;

// False, with a word on it, if the file is not a grid.
inline bool read(const char* name, Grid& grid) {
  std::FILE* file = std::fopen(name, "rb");
  const bool is_whole =
      file != nullptr && std::fread(grid.data(), 1, grid.size(), file) == grid.size();
  if (file != nullptr) {
    std::fclose(file);
  }
  if (!is_whole) {
    std::printf("%s: no grid of 1024 x 1024 bytes\n", name);
  }
  return is_whole;
}

inline Tile tile_of(const Grid& grid, std::size_t tile_x, std::size_t tile_y) {
  constexpr std::size_t kSide = tile_coding::kTileSide;
  Tile tile;
  for (std::size_t y = 0; y < kSide; ++y) {
    const std::size_t row = (tile_y * kSide + y) * kGridSide + tile_x * kSide;
    std::ranges::copy(std::span(grid).subspan(row, kSide),
                      tile.begin() + static_cast<std::ptrdiff_t>(y * kSide));
  }
  return tile;
}

inline bool is_known(const Tile& tile) {
  return std::ranges::any_of(tile, [](std::byte cell) { return cell != std::byte{0}; });
}

}  // namespace iog::lab
