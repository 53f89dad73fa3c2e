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
  for (const evidence::Group& group : window_->tile(slot).groups) {
    out = std::ranges::copy(group.decided, out).out;
  }
  return true;
}

}  // namespace iog::window
