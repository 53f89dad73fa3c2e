#include "window/opening.hpp"

#include "window/eight_bytes.hpp"
#include "window/tile_update.hpp"

namespace iog::window {

void Opening::find(const Window& window, const FrameEvidence& evidence, std::size_t slot) {
  const bool is_known = window.is_known(slot);
  const Plane stands = is_known ? window.tile(slot).found.stands : Plane{};
  const Plane taken = is_known ? window.tile(slot).found.taken : Plane{};
  Plane next = is_known ? window.tile(slot).from_below : Plane{};
  Plane high{};
  for (std::size_t group = 0; group < kGroupsPerTile; ++group) {
    const auto eight = EightBytes::load(&evidence.tile(slot)[group * evidence::kGroupCells]);
    if (!eight.is_zero()) {
      const unsigned low = eight.from_below();
      const unsigned met = eight.positive() & eight_of(stands, group);
      set_eight(high, group,
                static_cast<std::uint8_t>(eight.negative() & ~low & eight_of(taken, group)));
      set_eight(next, group, static_cast<std::uint8_t>((eight_of(next, group) | low) & ~met));
    }
  }
  high_[slot] = high;
  next_[slot] = next;
}

void Opening::leave_out_high(FrameEvidence& evidence, std::size_t slot) const {
  for (std::size_t group = 0; group < kGroupsPerTile; ++group) {
    if (const std::uint8_t cells = eight_of(high_[slot], group); cells != 0) {
      evidence.leave_out(slot, group, cells);
    }
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
