#include "window/slice_cells.hpp"

namespace iog::window {

void SliceCells::take_tile(std::size_t tile) {
  is_known_[tile] = true;
  std::int8_t* row = &cells_[first_of(tile)];
  for (std::size_t y = 0; y < geometry::kTileSide; ++y, row += kStride) {
    std::copy_n(&tile_cells_[y * geometry::kTileSide], geometry::kTileSide, row);
  }
}

void SliceCells::clear() {
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (!is_known_[tile]) {
      continue;
    }
    is_known_[tile] = false;
    std::int8_t* row = &cells_[first_of(tile)];
    for (std::size_t y = 0; y < geometry::kTileSide; ++y, row += kStride) {
      std::fill_n(row, geometry::kTileSide, std::int8_t{0});
    }
  }
}

}  // namespace iog::window
