#include "window/hit_list.hpp"

#include "window/slice_hits.hpp"

namespace iog::window {

void HitList::add(std::span<const PlacedCells> slices, const Area& area) {
  const geometry::Cell lowest{area.corner().a * kTileSide, area.corner().b * kTileSide};
  std::size_t count = count_;  // not in memory, where a hit might lie
  for (const PlacedCells& slice : slices) {
    for_each_hit(
        *slice.cells, CellMap::to_window(area, slice.at),
        [](geometry::Cell /*low*/, geometry::Cell /*high*/) { return true; },
        [&](geometry::Cell cell, std::int8_t /*byte*/) __attribute__((always_inline)) {
          if (!kWindowCells.contains(cell)) {
            return;
          }
          if (count < hits_.size()) {
            hits_[count++] = {.cell = {lowest.x + cell.x, lowest.y + cell.y},
                              .slice = slice.number};
          } else {
            ++left_;
          }
        });
  }
  count_ = count;
}

void HitList::clear() {
  count_ = 0;
  left_ = 0;
}

}  // namespace iog::window
