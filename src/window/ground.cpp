#include "window/ground.hpp"

namespace iog::window {
namespace {

// Whether a cell that is not beside what stands lacks the bit.
bool is_lacking(const Plane& plane, const Plane& beside) {
  std::uint32_t bits = 0;
  for (std::size_t y = 0; y < plane.size(); ++y) {
    bits |= ~(plane[y] | beside[y]);
  }
  return bits != 0;
}

Plane cells_beside(const Window& window, std::size_t slot) {
  return middle_of(dilated<1>(gather<1>(window.around(slot, &Found::stands))));
}

// A tile without a cell of its own that is freed, or seen, has none that is shut, or dense: a
// square of 5 by 5 cells that holds any given cell fits into the tile, and nothing in it is.
Plane cells_seen_around(const Window& window, std::size_t slot) {
  if (is_empty(window.tile(slot).found.seen)) {
    return Plane{};
  }
  return middle_of(eroded<2>(gather<2>(window.around(slot, &Found::seen))));
}

Plane cells_open_around(const Window& window, std::size_t slot) {
  if (is_empty(window.tile(slot).found.freed)) {
    return Plane{};
  }
  const Rows closed = eroded<2>(dilated<2>(gather<7>(window.around(slot, &Found::freed))));
  const Rows taken = gather<3>(window.around(slot, &Found::taken));
  return middle_of(eroded<3>(joined<AndNot>(closed, taken)));
}

}  // namespace

void remember(Window& window, std::size_t slot, bool is_new_period) {
  const Plane beside = cells_beside(window, slot);
  // What all cells have already is not looked for, because it stays.
  const Ground& before = window.tile(slot).ground;
  const Plane dense = is_lacking(before.dense, beside) ? cells_seen_around(window, slot) : Plane{};
  const Plane open =
      is_new_period || is_lacking(before.open, beside) ? cells_open_around(window, slot) : Plane{};
  const std::uint32_t period = is_new_period ? ~0U : 0U;
  Ground& ground = window.ground(slot);
  for (std::size_t y = 0; y < geometry::kTileSide; ++y) {
    const std::uint32_t kept = ~beside[y];
    const std::uint32_t low = ground.ticks_low[y];
    const std::uint32_t high = ground.ticks_high[y];
    const std::uint32_t up = open[y] & period & ~(low & high);
    ground.open[y] = (ground.open[y] | open[y]) & kept;
    ground.dense[y] = (ground.dense[y] | dense[y]) & kept;
    ground.ticks_low[y] = (low ^ up) & kept;
    ground.ticks_high[y] = (high ^ (up & low)) & kept;
  }
}

}  // namespace iog::window
