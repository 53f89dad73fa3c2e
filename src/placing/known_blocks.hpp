// Visits the 8 by 8 blocks of a window tile that may be near known cells of the slice grid. Moving
// an image by eight steps at once gives the same result as adding one step eight times.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lanes/bring.hpp"
#include "placing/placement.hpp"
#include "placing/slice_cells.hpp"

namespace iog::placing {

// A band of eight rows of a tile.
inline constexpr std::size_t kBandRows = SliceCells::kBlockSide;
inline constexpr std::size_t kBandCells = kBandRows * geometry::kTileSide;

// The cell centres of an 8 by 8 block span at most 7 * sqrt(2) cells along each axis of the grid.
// The block's image therefore fits into a square of 11 by 11 cells.
inline constexpr std::int32_t kBlockReach = 11;
static_assert(kBlockReach <= SliceCells::kMostNear);

// Calls visit(first, low, high, evidence) for each block that may be near known cells. `shape` is
// that of the slice. `first` is the image of the block's first cell. `low` and `high` bound the
// images of all cells in the block. `evidence` points to the evidence of the first cell. Returns
// false if no block was visited.
//
// The evidence of a band is prefetched first. Otherwise, its cache lines would be loaded one by one
// between the lookups.
template <typename Shape, typename Visit>
inline bool for_each_known_block(const SliceCells& slice, const Shape& shape, FinePoint first,
                                 FinePoint step,
                                 std::span<std::int8_t, geometry::kTileCells> evidence,
                                 Visit&& visit) {
  constexpr std::int32_t kSide = SliceCells::kBlockSide;
  const Reach block = Reach::of_square(kSide, step);
  bool is_any = false;
  for (std::size_t row = 0; row < geometry::kTileCells; row += kBandCells) {
    const std::span band = evidence.subspan(row).template first<kBandCells>();
    bool is_known = false;
    FinePoint at = first;
    for (std::size_t x = 0; x < geometry::kTileSide; x += kSide) {
      const geometry::Cell low = block.low(at);
      const geometry::Cell high = block.high(at);
      if (slice.is_known_near(low, high, shape)) {
        if (!is_known) {
          lanes::bring(std::as_bytes(band));
          is_known = true;
        }
        visit(at, low, high, &band[x]);
      }
      at = {at.x + kSide * step.x, at.y + kSide * step.y};
    }
    is_any = is_any || is_known;
    first = {first.x - kSide * step.y, first.y + kSide * step.x};
  }
  return is_any;
}

}  // namespace iog::placing
