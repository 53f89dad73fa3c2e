// Visits the hits of a slice. For each hit cell of the slice grid, visits the window cell that
// contains its centre. Tiles, bands of eight rows, and groups of eight cells without hits are
// skipped.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "geometry/cell.hpp"
#include "geometry/grid.hpp"
#include "lanes/eight_bytes.hpp"
#include "placing/hit_eights.hpp"
#include "placing/known_blocks.hpp"
#include "placing/placement.hpp"
#include "placing/slice_cells.hpp"

namespace iog::placing {

// Calls visit(cell, byte) for each hit of a band of eight rows. `first` is the image of the band's
// first cell.
template <typename Visit>
inline void for_each_hit_of_band(const std::int8_t* band, FinePoint first, FinePoint step,
                                 Visit& visit) {
  for (std::uint32_t eights = hit_eights(band); eights != 0; eights &= eights - 1) {
    const auto number = static_cast<std::uint32_t>(std::countr_zero(eights));
    const std::int8_t* const eight = band + number * lanes::EightBytes::kCount;
    const auto x = static_cast<std::int32_t>(number % kEightsPerRow * lanes::EightBytes::kCount);
    const auto y = static_cast<std::int32_t>(number / kEightsPerRow);
    const FinePoint at{first.x + x * step.x - y * step.y, first.y + x * step.y + y * step.x};
    for (std::uint32_t left = lanes::EightBytes::load(eight).positive(); left != 0;
         left &= left - 1) {
      const int i = std::countr_zero(left);
      visit(FinePoint{at.x + i * step.x, at.y + i * step.y}.cell(), eight[i]);
    }
  }
}

// Calls visit(cell, byte) for each hit. Cells are counted from the window's lowest cell, and may
// lie outside the window. Calls meets(low, high) with the bounds of a tile or band, and skips the
// tile or band if the result is false.
template <typename Meets, typename Visit>
inline void for_each_hit(const SliceCells& slice, const CellMap& to_window, Meets&& meets,
                         Visit&& visit) {
  constexpr std::int32_t kRows = std::int32_t{kBandRows};
  const FinePoint step = to_window.step();
  const Reach of_tile = Reach::of_square(window::kTileSide, step);
  const Reach of_band = Reach::of(window::kTileSide, kRows, step);
  for (const std::uint16_t tile : slice.hit_tiles()) {
    const geometry::Cell place = slice.tile_rows().place_of(tile);
    FinePoint first = to_window.exact({place.x * window::kTileSide, place.y * window::kTileSide});
    if (!meets(of_tile.low(first), of_tile.high(first))) {
      continue;
    }
    const std::int8_t* row = slice.cells(place).data();
    for (std::size_t band = 0; band < geometry::kTileSide / kBandRows; ++band) {
      if (slice.may_be_hit(tile, band) && meets(of_band.low(first), of_band.high(first))) {
        for_each_hit_of_band(row, first, step, visit);
      }
      row += kBandCells;
      first = {first.x - kRows * step.y, first.y + kRows * step.x};
    }
  }
}

}  // namespace iog::placing
