// A grid of indexes that is joined of others: what hits_win makes of all their evidence together.
//
// A cell is the saturated sum of the positive indexes that it has in the grids, if any, else of the
// negative ones (docs/model.md section 3). Sums of one sign saturate alike in any order. So a frame
// that is fused in parts, each from zero by hits_win, and joined is the frame fused as a whole,
// whichever its parts are.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "geometry/grid.hpp"
#include "grid/frame_grids.hpp"
#include "index/occupancy_index.hpp"

namespace iog::fusion {

// Adds the indexes of a tile to those of the same tile in another grid.
void join(std::span<index::OccupancyIndex, geometry::kTileCells> to,
          std::span<const index::OccupancyIndex, geometry::kTileCells> more);

// The bits (grid/frame_grids.hpp) of two grids' same tile joined: of a cell that is hit in one of
// them, of those in which it is hit.
[[nodiscard]] grid::TileBits join(
    std::span<const index::OccupancyIndex, geometry::kTileCells> one,
    const grid::TileBits& bits_of_one,
    std::span<const index::OccupancyIndex, geometry::kTileCells> other,
    const grid::TileBits& bits_of_other);

class JoinedGrid {
 public:
  using TileIndexes = std::span<const index::OccupancyIndex, geometry::kTileCells>;

  // Adds a tile of a grid, row by row from its lowest y. Something is known in it.
  void add(std::size_t tile, TileIndexes indexes);

  // Nothing is known of the tile.
  void forget(std::size_t tile) { is_known_[tile] = false; }

  // Shows the grid tile by tile and clears it, as FrameFusion::release() does.
  template <typename Visit>
  void release(Visit&& visit) {
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      if (is_known_[tile]) {
        is_known_[tile] = false;
        visit(tile, std::as_bytes(std::span(tiles_[tile])));
      }
    }
  }

 private:
  // A tile is known as soon as a cell of it is: no sum of one sign is 0. What is stored of another
  // means nothing.
  std::array<bool, geometry::kTileCount> is_known_{};
  alignas(32) std::array<std::array<index::OccupancyIndex, geometry::kTileCells>,
                         geometry::kTileCount> tiles_{};
};

}  // namespace iog::fusion
