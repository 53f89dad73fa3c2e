#include "objects/tile_tracks.hpp"

#include <algorithm>

#include "numeric/division.hpp"
#include "numeric/magnitude.hpp"
#include "objects/frame.hpp"
#include "window/tile.hpp"

namespace iog::objects {
namespace {

// Hits of a frame of 40 ms are at most 1/25 s old. This allows about twice that age, 1/12 s.
constexpr std::int32_t kOldestHitsPerSecond = 12;

// Bounds of the hits that a track may take, before they are moved with its velocity.
Bounds reach_of(const Track& track, const ClaimGate& gate) {
  const Velocity its = track.velocity();
  const std::int32_t faster = std::max(numeric::magnitude(its.x), numeric::magnitude(its.y));
  const std::int32_t more = gate.mm * 3 / 2 + faster / kOldestHitsPerSecond + geometry::kCellMm;
  return bounds_of(track.box()).grown(more);
}

}  // namespace

void TileTracks::insert(std::size_t tile, std::uint8_t slot) {
  Slots& slots = slots_[tile];
  std::size_t place = counts_[tile]++;
  for (; place > 0 && slots[place - 1] > slot; --place) {
    slots[place] = slots[place - 1];
  }
  slots[place] = slot;
}

std::uint32_t TileTracks::list(std::span<const Track> tracks, const ClaimGates& gates,
                               const window::Area& area) {
  counts_.fill(0);
  std::uint32_t left = 0;
  for (const bool moves : {true, false}) {
    for (std::size_t slot = 0; slot < tracks.size(); ++slot) {
      const Track& track = tracks[slot];
      if (track.is_there() && track.updates >= kClaimsFrom && track.moves() == moves) {
        reaches_[slot] = reach_of(track, gates[slot]);
        left += add(slot, reaches_[slot], area);
      }
    }
  }
  return left;
}

std::uint32_t TileTracks::add(std::size_t track, const Bounds& bounds, const window::Area& area) {
  constexpr std::int32_t kTileMm = window::kTileSide * geometry::kCellMm;
  const auto first_and_last = [](std::int32_t low_mm, std::int32_t high_mm, std::int32_t corner,
                                 std::int32_t tiles) {
    return Interval{std::max(numeric::div_floor(low_mm, kTileMm), corner),
                    std::min(numeric::div_floor(high_mm, kTileMm), corner + tiles - 1)};
  };
  const auto [columns, rows] = area.extent();
  const Interval a = first_and_last(bounds.low.x_mm, bounds.high.x_mm, area.corner().a, columns);
  const Interval b = first_and_last(bounds.low.y_mm, bounds.high.y_mm, area.corner().b, rows);
  std::uint32_t left = 0;
  for (std::int32_t y = b.low; y <= b.high; ++y) {
    for (std::int32_t x = a.low; x <= a.high; ++x) {
      const std::size_t tile = window::slot_of({x, y});
      if (counts_[tile] < kMostTracksOfATile) {
        insert(tile, static_cast<std::uint8_t>(track));
      } else {
        ++left;
      }
    }
  }
  return left;
}

std::span<const std::uint8_t> TileTracks::near(geometry::Cell cell) const {
  const std::size_t tile = window::slot_of(window::window_tile(cell));
  return std::span(slots_[tile]).first(counts_[tile]);
}

}  // namespace iog::objects
