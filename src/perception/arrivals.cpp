#include "perception/arrivals.hpp"

#include <algorithm>
#include <bit>

#include "placing/evidence_bits.hpp"

namespace iog::perception {
namespace {

constexpr std::size_t kMostRadius = 3;
constexpr int kEnoughOnWellKnownGround = 2;
constexpr int kEnough = 7;

// Whether a hit is on ground that was remembered.
bool is_any_on(const window::Plane& hits, const window::Ground& ground) {
  std::uint32_t bits = 0;
  for (std::size_t y = 0; y < hits.size(); ++y) {
    bits |= hits[y] & (ground.open[y] | ground.dense[y]);
  }
  return bits != 0;
}

// The cells of a tile within reach of a tall hit.
window::Plane near_tall(const window::NinePlanes& tall, int within) {
  static_assert(kTallOverGroundWithin <= 8);
  window::Rows rows =
      within <= kTallWithin ? window::gather<kTallWithin>(tall) : window::gather<8>(tall);
  for (int left = within; left > 0; left -= 3) {
    rows = window::dilated(rows, std::min(left, 3));
  }
  return window::middle_of(rows);
}

// The hits of a tile that are on ground freed by a low beam and near a tall hit.
window::Plane arriving(const window::Window& window, const placing::FrameEvidence& evidence,
                       std::size_t slot, int tall_within, const window::Plane& hits) {
  const window::Plane& from_below = window.tile(slot).from_below;
  window::Plane found;
  for (std::size_t y = 0; y < hits.size(); ++y) {
    found[y] = hits[y] & from_below[y];
  }
  if (window::is_empty(found)) {
    return found;
  }
  const window::Plane tall =
      near_tall(window.around(
                    slot, [&](std::size_t at) { return evidence.has_hit(at); },
                    [&](std::size_t at) -> const window::Plane& { return evidence.tall(at); }),
                tall_within);
  for (std::size_t y = 0; y < hits.size(); ++y) {
    found[y] &= tall[y];
  }
  return found;
}

// Counts new hits in the square around cell (x, y) of a tile.
int count_around(const window::Rows& rows, std::size_t y, int x, int radius) {
  const std::uint64_t run = (std::uint64_t{2} << (2 * radius)) - 1;
  const std::size_t reach = static_cast<std::size_t>(radius);
  int count = 0;
  for (std::size_t row = window::kRowMargin + y - reach; row <= window::kRowMargin + y + reach;
       ++row) {
    count += std::popcount(
        static_cast<std::uint32_t>(rows.words[row] >> (window::kColumnMargin - radius + x) & run));
  }
  return count;
}

}  // namespace

void Arrivals::find(const window::Window& window, const placing::FrameEvidence& evidence) {
  begin();
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    find_new(window, evidence, slot, placing::bits_of(evidence.tile(slot)).hit);
  }
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    find_moved(window, slot);
  }
}

void Arrivals::find_new(const window::Window& window, const placing::FrameEvidence& evidence,
                        std::size_t slot, const window::Plane& hits) {
  if (!evidence.is_touched(slot)) {
    return;
  }
  moved_[slot] = window::Plane{};
  if (!window.is_known(slot) || !evidence.has_hit(slot) ||
      !is_any_on(hits, window.tile(slot).ground)) {
    return;
  }
  const window::Plane arrived =
      is_from_below_ ? arriving(window, evidence, slot, tall_within_, hits) : hits;
  if (window::is_empty(arrived)) {
    return;
  }
  const window::Plane beside = window::middle_of(window::dilated(
      window::gather<1>(window.around(slot, &window::Found::stands)), around_.beside));
  const window::Tile& tile = window.tile(slot);
  for (std::size_t y = 0; y < hits.size(); ++y) {
    const std::uint32_t candidates = arrived[y] & ~beside[y];
    const std::uint32_t open = candidates & tile.ground.open[y];
    new_[slot][y] = open & tile.found.freed[y];
    open_[slot][y] = open & ~tile.ground.dense[y];
    moved_[slot][y] = candidates & tile.ground.dense[y];
  }
  has_new_[slot] = !window::is_empty(new_[slot]);
  has_open_[slot] = !window::is_empty(open_[slot]);
}

void Arrivals::count_new(const window::Window& window, std::size_t slot) {
  const window::Rows rows = window::gather<kMostRadius>(window.around(
      slot, [this](std::size_t at) { return has_new_[at]; },
      [this](std::size_t at) -> const window::Plane& { return new_[at]; }));
  const window::Ground& ground = window.tile(slot).ground;
  for (std::size_t y = 0; y < geometry::kTileSide; ++y) {
    const std::uint32_t well_known = ground.ticks_low[y] & ground.ticks_high[y];
    for (std::uint32_t left = open_[slot][y]; left != 0; left &= left - 1) {
      const int x = std::countr_zero(left);
      const std::uint32_t cell = left & (~left + 1);
      const int enough = (well_known & cell) != 0 ? kEnoughOnWellKnownGround : kEnough;
      if (count_around(rows, y, x, around_.open) >= enough) {
        moved_[slot][y] |= cell;
      }
    }
  }
}

}  // namespace iog::perception
