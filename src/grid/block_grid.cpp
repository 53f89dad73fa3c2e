#include "grid/block_grid.hpp"

#include <algorithm>

#include "grid/block_shapes.hpp"

namespace iog::grid {
namespace {

constexpr std::size_t kBlocksAtOnce = 4;
constexpr std::int32_t kHalves = geometry::kTileSide / static_cast<std::int32_t>(kLaneCount);

static_assert(kBlocksPerTile == kHalves * kBlocksAtOnce);

}  // namespace

BlockGrid::BlockGrid(const geometry::Grid& grid)
    : tiles_(grid), stride_(block_stride_of(grid)), area_(grid.area()) {
  for (std::size_t number = 0; number < strides_.size(); ++number) {
    const Orientation orientation = Orientation::of(number);
    strides_[number] = {orientation.strides(stride_),
                        orientation.strides(static_cast<std::ptrdiff_t>(tiles_.across()))};
  }
}

std::size_t BlockGrid::first_block(std::size_t tile) const {
  const geometry::Cell place = tiles_.place_of(tile);
  const auto x = static_cast<std::size_t>(place.x);
  const auto y = static_cast<std::size_t>(place.y);
  return (y * static_cast<std::size_t>(stride_) + x) * kBlocksPerTile;
}

const LaneBytes* BlockGrid::blocks_of(std::size_t tile) const {
  return &blocks_[first_block(tile)];
}

void BlockGrid::copy_cells(std::span<OccupancyIndex, geometry::kCellCount> to) const {
  std::ranges::fill(to, index::kUnknown);
  auto next = to.begin();
  for (std::int32_t y = 0; y < area_.height; ++y) {
    for (std::int32_t x = 0; x < area_.width; ++x) {
      *next++ = at({x, y});
    }
  }
}

bool BlockGrid::copy_tile(std::size_t tile,
                          std::span<OccupancyIndex, geometry::kTileCells> to) const {
  const Lanes least = Lanes::all(index::kIndexMin<OccupancyIndex>);
  Lanes known = Lanes::all(index::kUnknown);
  const LaneBytes* from = &blocks_[first_block(tile)];
  OccupancyIndex* row_start = to.data();
  const std::ptrdiff_t stride = stride_;  // which no store to a cell changes
  for (std::int32_t row = 0; row < kBlocksPerTile; ++row) {
    for (std::size_t half = 0; half < kHalves; ++half) {
      const std::array<Lanes, kBlockSide> rows = Lanes::rows_of(from + half * kBlocksAtOnce);
      OccupancyIndex* out = row_start + half * kLaneCount;
      for (const Lanes& cells : rows) {
        const Lanes raised = cells.max(least);
        known = known.bit_or(raised);
        raised.store_bytes(out);
        out += geometry::kTileSide;
      }
    }
    from += stride;
    row_start += std::ptrdiff_t{geometry::kTileSide} * kBlockSide;
  }
  return !known.is_zero();
}

void BlockGrid::clear_tile(std::size_t tile) {
  touched_[tile] = 0;
  const Lanes unknown = Lanes::all(index::kUnknown);
  LaneBytes* row = &blocks_[first_block(tile)];
  const std::ptrdiff_t stride = stride_;
  for (std::int32_t y = 0; y < kBlocksPerTile; ++y) {
    for (std::int32_t x = 0; x < kBlocksPerTile; ++x) {
      unknown.store(row[x]);
    }
    row += stride;
  }
}

}  // namespace iog::grid
