#include "window/hit_list.hpp"

#include "window/slice_hits.hpp"

namespace iog::window {

void HitList::add(std::span<const PlacedCells> slices, const Area& area) {
  const geometry::Cell lowest{area.corner().a * kTileSide, area.corner().b * kTileSide};
  for (const PlacedCells& slice : slices) {
    for_each_hit(
        *slice.cells, CellMap::to_window(area, slice.at),
        [](geometry::Cell /*low*/, geometry::Cell /*high*/) { return true; },
        [&](geometry::Cell cell, std::int8_t /*byte*/) {
          if (!kWindowCells.contains(cell)) {
            return;
          }
          if (count_ < hits_.size()) {
            hits_[count_++] = {.cell = {lowest.x + cell.x, lowest.y + cell.y},
                               .slice = slice.number};
          } else {
            ++left_;
          }
        });
  }
}

void HitList::clear() {
  count_ = 0;
  left_ = 0;
}

}  // namespace iog::window
