#include "window/opening.hpp"

namespace iog::window {

void Opening::find(const Window& window, const EvidenceBits& bits, std::size_t slot) {
  if (!window.is_known(slot)) {
    high_[slot] = {};
    next_[slot] = bits.from_below;
    return;
  }
  const Tile& tile = window.tile(slot);
  for (std::size_t y = 0; y < tile.from_below.size(); ++y) {
    const std::uint32_t low = bits.from_below[y];
    high_[slot][y] = bits.free[y] & ~low & tile.found.taken[y];
    next_[slot][y] = (tile.from_below[y] | low) & ~(bits.hit[y] & tile.found.stands[y]);
  }
}

void Opening::leave_out_high(FrameEvidence& evidence, std::size_t slot) const {
  if (looks_over_things_ && !is_empty(high_[slot])) {
    evidence.leave_out(slot, high_[slot]);
  }
}

void Opening::remember(Tile& tile, bool is_touched, std::size_t slot) const {
  if (is_touched) {
    tile.from_below = next_[slot];
  }
  for (std::size_t y = 0; y < tile.from_below.size(); ++y) {
    tile.found.freed[y] &= tile.from_below[y];
    tile.found.seen[y] &= tile.from_below[y];
  }
}

}  // namespace iog::window
