#include "grid/carving.hpp"

#include <algorithm>

#include "grid/carve_run.hpp"
#include "traversal/walk.hpp"

namespace iog::grid {
namespace {

// An amount of 127 is enough: a cell that is carved is 0 or below.
std::int8_t amount_of(std::int32_t freer) {
  return static_cast<std::int8_t>(std::min<std::int32_t>(freer, index::kIndexMax<OccupancyIndex>));
}

}  // namespace

// A block in which the steps change is carved once, with an amount for each of its cells: where the
// line enters the block the amount of before, and from each change on the new one.
void carve_blocks(BlockGrid& grid, BlockPath& path, const FreeSteps& steps) {
  const std::span<const FreeSteps::Change> changes = steps.changes();
  const std::uint32_t last_block = path.block_at(changes.back().at);
  path.extend_to(last_block);
  path.for_each_tile(last_block, [&](std::size_t tile) { grid.touch(tile); });

  const std::size_t quadrant = path.orientation().quadrant();
  const InnerMasks& from = kFromMasks[quadrant];
  const InnerMasks& after = kAfterMasks[quadrant];
  std::int32_t freer = steps.from_start();
  Lanes amount = Lanes::all(amount_of(freer));
  const auto carve_run_to = [&](std::uint32_t block, LaneBytes* at, std::uint32_t end) {
    if (freer > 0 && block + 1 < end) {
      const BlockRun run = path.run_from(block);
      Way way{run, at, *run.code, run.code + 1};
      carve_run(way, end - block - 1, amount);
    }
  };
  std::uint32_t number = path.block_at(changes.front().at);
  if (freer > 0 && number > 0) {
    LaneBytes* const first = grid.block_at(path.start_offset());
    carve_block(*first, Lanes::load(path.cells(0)), amount);
    carve_run_to(0, first, number);
  }
  const FreeSteps::Change* change = changes.data();
  const FreeSteps::Change* const end = change + changes.size();
  while (change != end) {
    const std::uint32_t this_block = number;
    std::uint32_t offset = 0;
    Lanes in_block = amount;
    do {
      offset = path.offset_at(change->at);
      freer += change->freer;
      amount = Lanes::all(amount_of(freer));
      const InnerMasks& masks = change->crossed > change->at.crossed() ? after : from;
      const Lanes rest = Lanes::load(masks[offset % kLaneCount]);
      in_block = in_block.and_not(rest).bit_or(amount.bit_and(rest));
      ++change;
      number = change != end ? path.block_at(change->at) : 0;
    } while (change != end && number == this_block);
    LaneBytes* const block = grid.block_at(offset);
    carve_block(*block, Lanes::load(path.cells(this_block)), in_block);
    if (change != end) {
      carve_run_to(this_block, block, number);
    }
  }
}

void carve_cells(BlockGrid& grid, const vehicle::BeamLine& line, traversal::Position first,
                 const FreeSteps& steps) {
  traversal::Walk walk(line, first, geometry::kCellsPerSide);
  std::int32_t freer = steps.from_start();
  for (const FreeSteps::Change& change : steps.changes()) {
    if (freer == 0) {
      walk.skip_until(change.crossed);
    } else {
      walk.until(change.crossed, [&](std::size_t number) {
        const geometry::Cell cell = geometry::cell_of(number);
        OccupancyIndex& index = grid.cell_at(offset_of(cell));
        index = index::sat_lower(index, -freer);
        grid.touch(geometry::tile_of(cell));
      });
    }
    freer += change.freer;
  }
}

}  // namespace iog::grid
