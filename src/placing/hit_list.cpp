#include "placing/hit_list.hpp"

#include "placing/slice_hits.hpp"

namespace iog::placing {

void HitList::add(std::span<const PlacedCells> slices, const window::Area& area) {
  const geometry::Cell lowest{area.corner().a * window::kTileSide,
                              area.corner().b * window::kTileSide};
  const geometry::CellArea inside = area.extent().cells();
  std::size_t count = count_;  // a local copy, because a store of a hit might alias count_
  for (const PlacedCells& slice : slices) {
    for_each_hit(
        *slice.cells, CellMap::to_window(area, slice.at),
        [](geometry::Cell /*low*/, geometry::Cell /*high*/) { return true; },
        [&](geometry::Cell cell, std::int8_t /*byte*/) __attribute__((always_inline)) {
          if (!inside.contains(cell)) {
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

}  // namespace iog::placing
