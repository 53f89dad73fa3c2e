// A grid joined from several grids of indexes: the result of hits_win for all of their evidence.
//
// A cell is the saturated sum of its positive indexes in the grids, or of the negative ones if none
// is positive (docs/model.md section 3). Sums of one sign saturate alike in any order. So a frame
// can be split in any way, each part fused from zero by hits_win, and the parts joined: the result
// equals the frame fused as a whole.
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

// Joins the bits (grid/frame_grids.hpp) of the same tile in two grids. If a cell is hit in some of
// the grids, only the bits of those grids count.
[[nodiscard]] grid::TileBits join(
    std::span<const index::OccupancyIndex, geometry::kTileCells> one,
    const grid::TileBits& bits_of_one,
    std::span<const index::OccupancyIndex, geometry::kTileCells> other,
    const grid::TileBits& bits_of_other);

class JoinedGrid {
 public:
  using TileIndexes = std::span<const index::OccupancyIndex, geometry::kTileCells>;

  // Adds a tile of a grid, row by row from its lowest y. The tile must have a known cell.
  void add(std::size_t tile, TileIndexes indexes);

  // Sets the tile to unknown.
  void forget(std::size_t tile) { is_known_[tile] = false; }

  // Visits the grid tile by tile and clears it, like FrameFusion::release().
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
  // A tile is known as soon as one of its cells is: no sum of one sign is 0. The stored cells of an
  // unknown tile are meaningless.
  std::array<bool, geometry::kTileCount> is_known_{};
  alignas(32) std::array<std::array<index::OccupancyIndex, geometry::kTileCells>,
                         geometry::kTileCount> tiles_{};
};

}  // namespace iog::fusion
