// The blocks of eight by eight cells of a tile of the window near which something may be known in
// the vehicle's grid. Points that are eight steps apart are eight additions of one step apart,
// exactly.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lanes/bring.hpp"
#include "placing/placement.hpp"
#include "placing/slice_cells.hpp"

namespace iog::placing {

// Eight rows of a tile.
inline constexpr std::size_t kBandRows = SliceCells::kBlockSide;
inline constexpr std::size_t kBandCells = kBandRows * geometry::kTileSide;

// Eight by eight cells reach 7 sqrt(2) cells far, and so are within a square of 11.
inline constexpr std::int32_t kBlockReach = 11;
static_assert(kBlockReach <= SliceCells::kMostNear);

// Calls visit(first, low, high, evidence) for each of them: where its first cell's centre lies in
// the grid, between which cells all of them do, and the first one's evidence. False if there is
// none.
//
// The evidence of a band is brought before: among what is looked up its lines would come one by
// one.
template <typename Visit>
inline bool for_each_known_block(const SliceCells& slice, FinePoint first, FinePoint step,
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
      if (slice.is_known_near(low, high)) {
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
