#include "window/window.hpp"

namespace iog::window {

void Window::follow(geometry::Cell vehicle) {
  const Area next = is_centred_ ? area_.following(vehicle) : Area::around(vehicle);
  is_centred_ = true;
  if (next.corner() == area_.corner()) {
    return;
  }
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    is_known_[slot] = is_known_[slot] && next.contains(area_.tile_at(slot));
  }
  area_ = next;
}

void Window::forget() {
  is_centred_ = false;
  is_known_.fill(false);
}

Tile& Window::open(std::size_t slot) {
  Tile& tile = tiles_[slot];
  if (!is_known_[slot]) {
    is_known_[slot] = true;
    tile.clear();
  }
  return tile;
}

}  // namespace iog::window
