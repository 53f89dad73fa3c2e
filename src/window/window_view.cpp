#include "window/window_view.hpp"

#include <algorithm>

namespace iog::window {

bool WindowView::copy_classes(std::size_t slot,
                              std::span<std::int8_t, geometry::kTileCells> to) const {
  if (!window_->is_known(slot)) {
    std::ranges::fill(to, std::int8_t{0});
    return false;
  }
  std::int8_t* out = to.data();
  const Tile& tile = window_->tile(slot);
  constexpr std::array<std::int8_t, evidence::kGroupCells> kUnknown{};
  for (std::size_t group = 0; group < kGroupsPerTile; ++group) {
    const auto& decided = tile.is_known(group) ? tile.groups[group].decided : kUnknown;
    out = std::ranges::copy(decided, out).out;
  }
  return true;
}

}  // namespace iog::window
