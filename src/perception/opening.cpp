#include "perception/opening.hpp"

namespace iog::perception {

void Opening::find(const window::Window& window, const placing::EvidenceBits& bits,
                   std::size_t slot) {
  if (!window.is_known(slot)) {
    high_[slot] = {};
    next_[slot] = bits.from_below;
    return;
  }
  const window::Tile& tile = window.tile(slot);
  for (std::size_t y = 0; y < tile.from_below.size(); ++y) {
    const std::uint32_t low = bits.from_below[y];
    high_[slot][y] = bits.free[y] & ~low & tile.found.taken[y];
    next_[slot][y] = (tile.from_below[y] | low) & ~(bits.hit[y] & tile.found.stands[y]);
  }
}

void Opening::leave_out_high(placing::FrameEvidence& evidence, std::size_t slot) const {
  if (looks_over_things_ && !window::is_empty(high_[slot])) {
    evidence.leave_out(slot, high_[slot]);
  }
}

void Opening::remember(window::Tile& tile, bool is_touched, std::size_t slot) const {
  if (is_touched) {
    tile.from_below = next_[slot];
  }
  for (std::size_t y = 0; y < tile.from_below.size(); ++y) {
    tile.found.freed[y] &= tile.from_below[y];
    tile.found.seen[y] &= tile.from_below[y];
  }
}

}  // namespace iog::perception
