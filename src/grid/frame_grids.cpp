#include "grid/frame_grids.hpp"

#include "grid/lanes.hpp"

namespace iog::grid {

// Both are below 0, or both above.
TileBits FrameGrids::low_and_tall(std::size_t tile) const {
  TileBits bits{};
  if (!heights.is_touched(tile)) {
    return bits;
  }
  constexpr std::size_t kBlocksOfLanes = kLaneCount / kBlockSide;
  constexpr std::size_t kLanesOfRow = geometry::kTileSide / kLaneCount;
  const Lanes zero = Lanes::all(0);
  for (std::int32_t row = 0; row < kBlocksPerTile; ++row) {
    for (std::size_t half = 0; half < kLanesOfRow; ++half) {
      const std::size_t first = half * kBlocksOfLanes;
      const auto cells = Lanes::rows_of(indexes.blocks_of(tile, row) + first);
      const auto levels = Lanes::rows_of(heights.blocks_of(tile, row) + first);
      for (std::size_t y = 0; y < kBlockSide; ++y) {
        const Lanes low = cells[y].bit_and(levels[y]);
        const Lanes tall = zero.subtract(cells[y]).bit_and(zero.subtract(levels[y]));
        bits[static_cast<std::size_t>(row) * kBlockSide + y] |= low.bit_or(tall).negative()
                                                                << half * kLaneCount;
      }
    }
  }
  return bits;
}

}  // namespace iog::grid
