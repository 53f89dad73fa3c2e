#include "grid/frame_grids.hpp"

#include <algorithm>

#include "lanes/lanes.hpp"

namespace iog::grid {

namespace {

using RowsOfBlocks = std::array<Lanes, kBlockSide>;

// Below 0 where both bytes are below 0, or both above.
RowsOfBlocks both_low_or_tall(const LaneBytes* indexes, const LaneBytes* heights) {
  RowsOfBlocks cells = Lanes::rows_of(indexes);
  const RowsOfBlocks levels = Lanes::rows_of(heights);
  const Lanes zero = Lanes::all(0);
  for (std::size_t y = 0; y < cells.size(); ++y) {
    const Lanes low = cells[y].bit_and(levels[y]);
    const Lanes tall = zero.subtract(cells[y]).bit_and(zero.subtract(levels[y]));
    cells[y] = low.bit_or(tall);
  }
  return cells;
}

}  // namespace

TileBits FrameGrids::low_and_tall(std::size_t tile) const {
  if (!heights.is_touched(tile)) {
    return TileBits{};
  }
  constexpr std::size_t kHalf = kBlocksPerTile / 2;
  static_assert(kHalf * kBlockSide == kLaneCount);
  TileBits bits;
  const LaneBytes* cells = indexes.blocks_of(tile);
  const LaneBytes* levels = heights.blocks_of(tile);
  for (std::int32_t row = 0; row < kBlocksPerTile; ++row) {
    const auto four = Lanes::negative(both_low_or_tall(cells, levels),
                                      both_low_or_tall(cells + kHalf, levels + kHalf));
    std::ranges::copy(four, &bits[static_cast<std::size_t>(row) * kBlockSide]);
    cells += indexes.stride();
    levels += heights.stride();
  }
  return bits;
}

}  // namespace iog::grid
