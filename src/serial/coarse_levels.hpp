// The coarse grids of a frame, two levels of its quadtree: a fine one of 128 x 128 cells and a
// rough one of 32 x 32. With 1024 x 1024 cells of 0.1 m they are levels 3 and 5, with cells of 0.8
// m and 3.2 m.
//
// A coarse cell has the highest index of the cells below it. It is occupied if any of them is, free
// if all of them are, and otherwise unknown.
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
  // The rough grid is one tile, the fine one 4 by 4.
  static constexpr unsigned kRoughLevel = std::countr_zero(geometry::kTilesPerSide);
  static constexpr unsigned kFineLevel = kRoughLevel - 2;
  static constexpr std::size_t kFineTilesPerSide = 4;
  static constexpr std::size_t kFineTileCount = kFineTilesPerSide * kFineTilesPerSide;

  // Sets all cells to unknown.
  void clear();

  // Adds a tile of the grid by its number.
  void add_tile(std::size_t tile, tile_coding::TileCells cells);

  // The tiles of the fine grid. All cells of a tile that is not known are unknown.
  [[nodiscard]] bool is_fine_known(std::size_t fine_tile) const {
    return (known_fine_tiles_ >> fine_tile & 1U) != 0;
  }
  [[nodiscard]] tile_coding::TileCells fine(std::size_t fine_tile) const {
    return std::as_bytes(std::span(fine_[fine_tile]));
  }

  // The only tile of the rough grid.
  [[nodiscard]] bool is_rough_known() const { return known_fine_tiles_ != 0; }
  void copy_rough(tile_coding::MutableTileCells rough) const;

 private:
  using Tile = std::array<std::int8_t, tile_coding::kTileBytes>;

  alignas(8) std::array<Tile, kFineTileCount> fine_{};
  std::uint32_t known_fine_tiles_ = 0;
};

}  // namespace iog::serial
