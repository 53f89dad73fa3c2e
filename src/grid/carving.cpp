#include "grid/carving.hpp"

#include <algorithm>

#include "traversal/walk.hpp"

namespace iog::grid {
namespace {

// More than that is no more: any cell of a beam was 0 or below.
std::int8_t amount_of(std::int32_t freer) {
  return static_cast<std::int8_t>(std::min<std::int32_t>(freer, index::kIndexMax<OccupancyIndex>));
}

// The blocks that follow `block` along the run, `count` of them, by the same amount. The blocks of
// a line differ, so four can be loaded before the first of them is stored.
void carve_run(BlockRun run, LaneBytes* block, std::uint32_t count, Lanes amount) {
  constexpr std::uint32_t kAtOnce = 4;
  const auto next = [&] {
    block += (*run.code & 1U) != 0 ? run.v_stride : run.u_stride;
    ++run.code;
    return block;
  };
  const auto cells = [&] { return Lanes::load(run.masks[*run.code / 2U]).masked(amount); };
  for (; count >= kAtOnce; count -= kAtOnce) {
    LaneBytes* const a = next();
    const Lanes of_a = cells();
    LaneBytes* const b = next();
    const Lanes of_b = cells();
    LaneBytes* const c = next();
    const Lanes of_c = cells();
    LaneBytes* const d = next();
    const Lanes of_d = cells();
    const Lanes in_a = Lanes::load(*a);
    const Lanes in_b = Lanes::load(*b);
    const Lanes in_c = Lanes::load(*c);
    const Lanes in_d = Lanes::load(*d);
    in_a.subtract(of_a).store(*a);
    in_b.subtract(of_b).store(*b);
    in_c.subtract(of_c).store(*c);
    in_d.subtract(of_d).store(*d);
  }
  for (; count > 0; --count) {
    LaneBytes* const a = next();
    Lanes::load(*a).subtract(cells()).store(*a);
  }
}

}  // namespace

// A block in which something changes is carved once: with what holds where the line enters it, and
// from each change on with what holds then.
void carve_blocks(BlockGrid& grid, BlockPath& path, const FreeSteps& steps) {
  const std::span<const FreeSteps::Change> changes = steps.changes();
  const std::uint32_t last_block = changes.back().place.block;
  path.extend_to(last_block);
  path.for_each_tile(last_block, [&](std::size_t tile) { grid.touch(tile); });

  const std::size_t quadrant = path.orientation().quadrant();
  const InnerMasks& from = kFromMasks[quadrant];
  const InnerMasks& after = kAfterMasks[quadrant];
  std::int32_t freer = 0;
  Lanes amount = Lanes::all(0);
  auto change = changes.begin();
  while (change != changes.end()) {
    const Place place = change->place;
    LaneBytes* const block = grid.block_at(place.offset);
    Lanes in_block = amount;
    for (; change != changes.end() && change->place.block == place.block; ++change) {
      freer += change->freer;
      amount = Lanes::all(amount_of(freer));
      const InnerMasks& masks = change->is_after ? after : from;
      const Lanes rest = Lanes::load(masks[change->place.offset % kLaneCount]);
      in_block = in_block.without(rest).united(amount.masked(rest));
    }
    Lanes::load(*block).subtract(in_block.masked(Lanes::load(path.cells(place.block)))).store(*block);
    if (change != changes.end() && freer > 0) {
      const std::uint32_t count = change->place.block - place.block - 1;
      carve_run(path.run_from(place.block), block, count, amount);
    }
  }
}

void carve_cells(BlockGrid& grid, const vehicle::BeamLine& line, const FreeSteps& steps) {
  traversal::Walk walk(line, steps.first(), kStride);
  std::int32_t freer = 0;
  for (const FreeSteps::Change& change : steps.changes()) {
    walk.until(change.crossed, [&](std::size_t number) {
      const traversal::Cell cell = cell_of(number);
      OccupancyIndex& index = grid.cell_at(offset_of(cell));
      index = index::sat_lower(index, -freer);
      grid.touch(tile_of(cell));
    });
    freer += change.freer;
  }
}

}  // namespace iog::grid
