#include "placing/slice_cells.hpp"

#include <algorithm>
#include <numeric>

namespace iog::placing {

void SliceCells::copy(std::size_t tile, TileIndexes indexes, const window::Plane& low_and_tall) {
  std::int8_t* const bytes = tiles_[places_[tile]].data();
  notes_[tile] = write_bytes(indexes.data(), bytes);
  is_known_[tile] = true;
  if (!window::is_empty(low_and_tall)) {
    set_beside(low_and_tall, bytes);
  }
}

void SliceCells::note(std::size_t tile) {
  note_extent(tile);
  if (notes_[tile].hit_bands != 0) {
    hit_tiles_[hit_tile_count_++] = static_cast<std::uint16_t>(tile);
  }
  note_known(tile);
}

void SliceCells::note_known(std::size_t tile) {
  std::size_t at = (kRowsAround + tile / geometry::kTilesPerSide * kSquaresOfTile) * kSquareStride +
                   1 + tile % geometry::kTilesPerSide;
  for (const std::uint8_t row : notes_[tile].known) {
    squares_[at] = row;
    at += kSquareStride;
  }
}

void SliceCells::note_extent(std::size_t tile) {
  const auto x = static_cast<std::int32_t>(tile % geometry::kTilesPerSide);
  const auto y = static_cast<std::int32_t>(tile / geometry::kTilesPerSide);
  extent_ = {{std::min(extent_.low.x, x), std::min(extent_.low.y, y)},
             {std::max(extent_.high.x, x), std::max(extent_.high.y, y)}};
}

void SliceCells::clear() {
  is_known_.fill(false);
  used_ = 0;
  forget_notes();
}

// Each tile has a fixed place, so any core may copy it.
void SliceCells::begin() { std::iota(places_.begin(), places_.end(), std::uint16_t{0}); }

void SliceCells::forget_notes() {
  squares_.fill(0);
  extent_ = {};
  hit_tile_count_ = 0;
}

void SliceCells::note_all() {
  forget_notes();
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (is_known_[tile]) {
      note(tile);
    }
  }
}

}  // namespace iog::placing
