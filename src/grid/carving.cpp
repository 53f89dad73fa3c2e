#include "grid/carving.hpp"

#include <algorithm>

#include "grid/carve_run.hpp"
#include "traversal/walk.hpp"

namespace iog::grid {
namespace {

constexpr std::uint32_t kSide = kBlockSide;

// Larger amounts have the same effect: a cell being carved is 0 or below.
constexpr std::int32_t kMostFreer = index::kIndexMax<OccupancyIndex>;

std::int8_t amount_of(std::int32_t freer) {
  return static_cast<std::int8_t>(std::min(freer, kMostFreer));
}

// A block in which the steps change is carved once, with an amount per cell: the old amount where
// the line enters the block, and the new one from each change on.
template <bool kHasGaps>
[[gnu::always_inline]] inline void carve_path(BlockGrid& grid, BlockPath& path, FreeSteps& steps) {
  const traversal::Position last = steps.last().at();
  path.find_up_to(path.block_at(last));
  const Orientation orientation = path.orientation();
  const BlockGrid::LineStrides& strides = grid.strides(orientation.number());
  path.for_each_tile(last, strides.tiles, [&](std::size_t tile) { grid.touch(tile); });

  const traversal::Position corner = path.from_corner({});
  const BlockMasks& masks = path.masks();
  LaneBytes* const start = grid.block_at(path.start_offset());
  Way way = path.way_from(start, strides.blocks);
  Lanes cells = Lanes::load(way.cells()).bit_and(path.start_mask());
  std::uint32_t number = 0;
  std::int32_t freer = steps.from_start();
  Lanes amount = Lanes::all(amount_of(freer));
  Lanes in_block = amount;
  steps.take_changes([&](Between point, std::int32_t change) {
    const std::int32_t freer_before = freer;
    freer += change;
    if (std::min(freer_before, freer) >= kMostFreer) {
      return;
    }
    const traversal::Position at = point.at();
    const std::uint32_t x = at.x + corner.x;
    const std::uint32_t y = at.y + corner.y;
    const std::uint32_t its_number = x / kSide + y / kSide;
    if (its_number != number) {
      carve_block(*way.block, cells, in_block);
      if (kHasGaps && freer_before == 0) {
        way.step_to(start + path.stride_to({x, y}, way.strides), its_number - number);
      } else {
        carve_run(way, its_number - number - 1, amount);
        way.step();
      }
      cells = Lanes::load(way.cells());
      number = its_number;
      in_block = amount;
    }
    amount = Lanes::all(amount_of(freer));
    const std::uint32_t inner = orientation.inner_of(x % kSide, y % kSide);
    const Lanes rest = Lanes::load((point.is_after() ? masks.after : masks.from)[inner]);
    in_block = in_block.and_not(rest).bit_or(amount.bit_and(rest));
  });
  carve_block(*way.block, cells, in_block);
}

}  // namespace

void carve_blocks(BlockGrid& grid, BlockPath& path, FreeSteps& steps) {
  carve_path<false>(grid, path, steps);
}
void carve_blocks(BlockGrid& grid, BlockPath& path, LowSteps& steps) {
  carve_path<true>(grid, path, steps);
}

void carve_cells(BlockGrid& grid, const vehicle::BeamLine& line, traversal::Position first,
                 FreeSteps& steps) {
  traversal::Walk walk(line, first, geometry::kLongestSide);
  std::int32_t freer = steps.from_start();
  steps.take_changes([&](Between point, std::int32_t change) {
    if (freer == 0) {
      walk.skip_until(point.crossed());
    } else {
      walk.until(point.crossed(), [&](std::size_t number) {
        const geometry::Cell cell = geometry::cell_of(number, geometry::kLongestSide);
        OccupancyIndex& index = grid.cell_at(offset_of(cell, grid.stride()));
        index = index::sat_lower(index, -freer);
        grid.touch(geometry::tile_of(cell, grid.tiles_across()));
      });
    }
    freer += change;
  });
}

}  // namespace iog::grid
