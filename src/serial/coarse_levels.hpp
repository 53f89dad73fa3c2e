// The coarse grids of a frame: two levels of its quadtree, a fine one of 128 by 128 cells and a
// rough one of 32 by 32. With 1024 by 1024 cells of 0.1 m they are levels 3 and 5, cells of 0.8 and
// 3.2 m.
//
// A coarse cell has the highest index of the cells below it: where something is occupied it is,
// too; where it is free, all of it is; else it is unknown.
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

  // Everything is unknown.
  void clear();

  // A tile of the grid, by its number, while its cells are at hand.
  void add_tile(std::size_t tile, tile_coding::TileCells cells);

  // The tiles of the fine grid. If one is not known, none of its cells is.
  [[nodiscard]] bool is_fine_known(std::size_t fine_tile) const {
    return (known_fine_tiles_ >> fine_tile & 1U) != 0;
  }
  [[nodiscard]] tile_coding::TileCells fine(std::size_t fine_tile) const {
    return std::as_bytes(std::span(fine_[fine_tile]));
  }

  // The one tile of the rough grid.
  [[nodiscard]] bool is_rough_known() const { return known_fine_tiles_ != 0; }
  void copy_rough(tile_coding::MutableTileCells rough) const;

 private:
  using Tile = std::array<std::int8_t, tile_coding::kTileBytes>;

  alignas(8) std::array<Tile, kFineTileCount> fine_{};
  std::uint32_t known_fine_tiles_ = 0;
};

}  // namespace iog::serial
