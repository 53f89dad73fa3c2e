// The coarse grids of a frame are two levels of the frame's quadtree: a *fine* grid of 128 x 128
// cells and a *rough* grid of 32 x 32 cells. If a grid has 1024 x 1024 cells of 0.1 m, the coarse
// grids are levels 3 and 5 of its quadtree, with cells of 0.8 m and 3.2 m.
//
// The index of a coarse cell is the highest index of the cells in it. A coarse cell is therefore
// occupied if any cell in it is occupied, free if all cells in it are free, and unknown otherwise.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::serial {

class CoarseLevels {
 public:
  // The rough grid is one tile, and the fine grid is 4 by 4 tiles.
  static constexpr unsigned kRoughLevel = std::countr_zero(geometry::kTilesPerSide);
  static constexpr unsigned kFineLevel = kRoughLevel - 2;
  static constexpr std::size_t kFineTilesPerSide = 4;
  static constexpr std::size_t kFineTileCount = kFineTilesPerSide * kFineTilesPerSide;

  // Sets all cells to unknown.
  void clear();

  // Adds the tile with the index `tile` in the full-resolution grid.
  void add_tile(std::size_t tile, tile_coding::TileCells cells);

  // These functions access the tiles of the fine grid. If a tile is not known, all its cells are
  // unknown.
  [[nodiscard]] bool is_fine_known(std::size_t fine_tile) const {
    return (known_fine_tiles_ >> fine_tile & 1U) != 0;
  }
  [[nodiscard]] tile_coding::TileCells fine(std::size_t fine_tile) const {
    return std::as_bytes(std::span(fine_[fine_tile]));
  }

  // These functions access the only tile of the rough grid.
  [[nodiscard]] bool is_rough_known() const { return known_fine_tiles_ != 0; }
  void copy_rough(tile_coding::MutableTileCells rough) const;

 private:
  using Tile = std::array<std::int8_t, tile_coding::kTileBytes>;

  alignas(8) std::array<Tile, kFineTileCount> fine_{};
  std::uint32_t known_fine_tiles_ = 0;
};

}  // namespace iog::serial
