#include "window/arrivals.hpp"

#include <bit>

#include "window/evidence_bits.hpp"

namespace iog::window {
namespace {

constexpr int kRadius = 3;
constexpr std::uint64_t kRun = (1U << (2 * kRadius + 1)) - 1;
constexpr int kEnoughOnWellKnownGround = 2;
constexpr int kEnough = 7;

// Whether a hit is on ground of which something is remembered.
bool is_any_on(const Plane& hits, const Ground& ground) {
  std::uint32_t bits = 0;
  for (std::size_t y = 0; y < hits.size(); ++y) {
    bits |= hits[y] & (ground.open[y] | ground.dense[y]);
  }
  return bits != 0;
}

// The cells of a tile that are near a tall hit.
Plane near_tall(const NinePlanes& tall, int within) {
  if (within == kTallWithin) {
    return middle_of(dilated<kTallWithin>(gather<kTallWithin>(tall)));
  }
  static_assert(kTallOverGroundWithin == 3 + 3 + 2);
  return middle_of(dilated<2>(dilated<3>(dilated<3>(gather<kTallOverGroundWithin>(tall)))));
}

// Of the hits of a tile those that something made which is tall and came where a low beam had been.
Plane arriving(const Window& window, const FrameEvidence& evidence, std::size_t slot,
               int tall_within, const Plane& hits) {
  const Plane& from_below = window.tile(slot).from_below;
  Plane found;
  for (std::size_t y = 0; y < hits.size(); ++y) {
    found[y] = hits[y] & from_below[y];
  }
  if (is_empty(found)) {
    return found;
  }
  const Plane tall =
      near_tall(window.around(
                    slot, [&](std::size_t at) { return evidence.has_hit(at); },
                    [&](std::size_t at) -> const Plane& { return evidence.tall(at); }),
                tall_within);
  for (std::size_t y = 0; y < hits.size(); ++y) {
    found[y] &= tall[y];
  }
  return found;
}

// The new hits in the square around a cell of a tile. The mask is of the cell's column.
int count_around(const Rows& rows, std::size_t y, int x) {
  int count = 0;
  for (std::size_t row = kRowMargin + y - kRadius; row <= kRowMargin + y + kRadius; ++row) {
    const auto run =
        static_cast<std::uint32_t>(rows.words[row] >> (kColumnMargin - kRadius + x) & kRun);
    count += std::popcount(run);
  }
  return count;
}

}  // namespace

void Arrivals::find(const Window& window, const FrameEvidence& evidence) {
  begin();
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    find_new(window, evidence, slot, bits_of(evidence.tile(slot)).hit);
  }
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    find_moved(window, slot);
  }
}

void Arrivals::find_new(const Window& window, const FrameEvidence& evidence, std::size_t slot,
                        const Plane& hits) {
  if (!evidence.is_touched(slot)) {
    return;
  }
  moved_[slot] = Plane{};
  if (!window.is_known(slot) || !evidence.has_hit(slot) ||
      !is_any_on(hits, window.tile(slot).ground)) {
    return;
  }
  const Plane arrived =
      is_from_below_ ? arriving(window, evidence, slot, tall_within_, hits) : hits;
  if (is_empty(arrived)) {
    return;
  }
  const Plane beside = middle_of(dilated<1>(gather<1>(window.around(slot, &Found::stands))));
  const Tile& tile = window.tile(slot);
  for (std::size_t y = 0; y < hits.size(); ++y) {
    const std::uint32_t candidates = arrived[y] & ~beside[y];
    const std::uint32_t open = candidates & tile.ground.open[y];
    new_[slot][y] = open & tile.found.freed[y];
    open_[slot][y] = open & ~tile.ground.dense[y];
    moved_[slot][y] = candidates & tile.ground.dense[y];
  }
  has_new_[slot] = !is_empty(new_[slot]);
  has_open_[slot] = !is_empty(open_[slot]);
}

void Arrivals::count_new(const Window& window, std::size_t slot) {
  const Rows rows = gather<kRadius>(window.around(
      slot, [this](std::size_t at) { return has_new_[at]; },
      [this](std::size_t at) -> const Plane& { return new_[at]; }));
  const Ground& ground = window.tile(slot).ground;
  for (std::size_t y = 0; y < geometry::kTileSide; ++y) {
    const std::uint32_t well_known = ground.ticks_low[y] & ground.ticks_high[y];
    for (std::uint32_t left = open_[slot][y]; left != 0; left &= left - 1) {
      const int x = std::countr_zero(left);
      const std::uint32_t cell = left & (~left + 1);
      const int enough = (well_known & cell) != 0 ? kEnoughOnWellKnownGround : kEnough;
      if (count_around(rows, y, x) >= enough) {
        moved_[slot][y] |= cell;
      }
    }
  }
}

}  // namespace iog::window
