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
  const auto [x, y] = tile_rows_.place_of(tile);
  extent_ = {{std::min(extent_.low.x, x), std::min(extent_.low.y, y)},
             {std::max(extent_.high.x, x), std::max(extent_.high.y, y)}};
  if (notes_[tile].hit_bands != 0) {
    hit_tiles_[hit_tile_count_++] = static_cast<std::uint16_t>(tile);
  }
  const auto stride =
      static_cast<std::size_t>(shape_.square_stride());  // which no store to a byte changes
  std::uint8_t* at =
      &squares_[(kRowsAround + static_cast<std::size_t>(y) * kSquaresOfTile) * stride + 1 +
                static_cast<std::size_t>(x)];
  const auto known = notes_[tile].known;
  for (const std::uint8_t row : known) {
    *at = row;
    at += stride;
  }
}

void SliceCells::clear() {
  is_known_.fill(false);
  used_ = 0;
  forget_notes();
}

// Each tile has a fixed place, so any core may copy it.
void SliceCells::begin() { std::iota(places_.begin(), places_.end(), std::uint16_t{0}); }

void SliceCells::forget_notes() {
  const auto rows = static_cast<std::size_t>(shape_.cells().height) / kSquareSide + 2 * kRowsAround;
  std::fill_n(squares_.begin(), rows * static_cast<std::size_t>(shape_.square_stride()), 0);
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
