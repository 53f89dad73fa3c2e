#include "grid/block_grid.hpp"

namespace iog::grid {
namespace {

constexpr std::size_t kBlocksAtOnce = 4;
constexpr std::int32_t kHalves = geometry::kTileSide / static_cast<std::int32_t>(kLaneCount);

// Index of the tile's first stored block.
constexpr std::size_t first_block(std::size_t tile) {
  const std::size_t row = tile / geometry::kTilesPerSide * kBlocksPerTile;
  return row * kBlockStride + tile % geometry::kTilesPerSide * kBlocksPerTile;
}

static_assert(kBlocksPerTile == kHalves * kBlocksAtOnce);

}  // namespace

const LaneBytes* BlockGrid::blocks_of(std::size_t tile, std::int32_t row) const {
  return &blocks_[first_block(tile) + static_cast<std::size_t>(row) * kBlockStride];
}

void BlockGrid::copy_cells(std::span<OccupancyIndex, geometry::kCellCount> to) const {
  for (std::size_t number = 0; number < geometry::kCellCount; ++number) {
    to[number] = at(geometry::cell_of(number));
  }
}

bool BlockGrid::copy_tile(std::size_t tile,
                          std::span<OccupancyIndex, geometry::kTileCells> to) const {
  const Lanes least = Lanes::all(index::kIndexMin<OccupancyIndex>);
  Lanes known = Lanes::all(index::kUnknown);
  const LaneBytes* from = &blocks_[first_block(tile)];
  OccupancyIndex* row_start = to.data();
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
    from += kBlockStride;
    row_start += std::ptrdiff_t{geometry::kTileSide} * kBlockSide;
  }
  return !known.is_zero();
}

void BlockGrid::clear_tile(std::size_t tile) {
  touched_[tile] = 0;
  const Lanes unknown = Lanes::all(index::kUnknown);
  LaneBytes* row = &blocks_[first_block(tile)];
  for (std::int32_t y = 0; y < kBlocksPerTile; ++y) {
    for (std::int32_t x = 0; x < kBlocksPerTile; ++x) {
      unknown.store(row[x]);
    }
    row += kBlockStride;
  }
}

}  // namespace iog::grid
