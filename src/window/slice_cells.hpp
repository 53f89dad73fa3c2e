// The index grid of a slice row by row, so that a cell is found by one multiplication.
//
// It is a copy: a slice's cells are looked up four times as often as they are copied. Rows are
// stored two cache lines longer than they are, otherwise the cells of a column would compete for a
// few sets of a level 1 cache.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"

namespace iog::window {

class SliceCells {
 public:
  static constexpr std::size_t kStride = geometry::kCellsPerSide + 64;

  // Takes over a grid that is read like a grid::FrameView: is_touched(tile) and copy_tile(tile,
  // cells), which is false if all of them are unknown. Before, all cells are unknown.
  template <typename View>
  void take(const View& view) {
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      if (view.is_touched(tile) && view.copy_tile(tile, tile_cells_)) {
        take_tile(tile);
      }
    }
  }

  // All cells are unknown again.
  void clear();

  // Whether something is known in a tile of the grid.
  [[nodiscard]] bool is_known(std::size_t tile) const { return is_known_[tile]; }

  // The grid's cells, kStride from one row to the next.
  [[nodiscard]] const std::int8_t* cells() const { return cells_.data(); }

  // The first cell of a tile.
  [[nodiscard]] static constexpr std::size_t first_of(std::size_t tile) {
    return tile / geometry::kTilesPerSide * geometry::kTileSide * kStride +
           tile % geometry::kTilesPerSide * geometry::kTileSide;
  }

 private:
  void take_tile(std::size_t tile);

  alignas(32) std::array<std::int8_t, geometry::kCellsPerSide * kStride> cells_{};
  alignas(8) std::array<std::int8_t, geometry::kTileCells> tile_cells_{};
  std::array<bool, geometry::kTileCount> is_known_{};
};

}  // namespace iog::window
