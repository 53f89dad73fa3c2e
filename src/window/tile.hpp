// One tile of the window as it lies in memory: 32 by 32 cells aligned to the local frame.
//
// A tile of which nothing is known is all zeros, but for groups that were never aged, which hold
// nothing that means something, so that a tile is cleared without going through all of it, and for
// what the map says of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ageing/clock.hpp"
#include "decision/decision.hpp"
#include "evidence/group.hpp"
#include "geometry/tile.hpp"

namespace iog::window {

inline constexpr std::size_t kGroupsPerRow = geometry::kTileSide / evidence::kGroupCells;
inline constexpr std::size_t kGroupsPerTile = geometry::kTileCells / evidence::kGroupCells;

// A bit a cell: bit x of word y, y from the lowest.
using Plane = std::array<std::uint32_t, geometry::kTileSide>;
static_assert(geometry::kTileSide == 32);

// No cell has the bit. All words are read: that is quicker than to ask each.
[[nodiscard]] inline bool is_empty(const Plane& plane) {
  std::uint32_t bits = 0;
  for (const std::uint32_t row : plane) {
    bits |= row;
  }
  return bits == 0;
}

// What the map rules out in a tile, row by row from the lowest y.
using TileRuledOut = std::array<decision::RuledOut, kGroupsPerTile>;
alignas(8) inline constexpr decision::RuledOut kNothingRuledOut{};

// What is asked of a cell's neighbourhood, as found when its group was last decided.
struct Found {
  Plane freed{};   // free for more than it is not
  Plane seen{};    // free by evidence of that very frame
  Plane stands{};  // occupied for long
  Plane taken{};   // occupied at all
};

// What is remembered of the ground, whatever is on it now.
struct Ground {
  Plane open{};       // it was free, with a margin
  Plane dense{};      // it was seen free all around in one frame
  Plane ticks_low{};  // 0 ... 3: how often it was found open again
  Plane ticks_high{};
};

struct Tile {
  // Nothing is known of any cell.
  void clear();

  // Whether something was ever known of the group.
  [[nodiscard]] bool is_known(std::size_t group) const {
    return aged_at[group] != ageing::Clock::kNever;
  }

  // What the map rules out in a group. Without a map nobody reads a kilobyte of zeros.
  [[nodiscard]] const decision::RuledOut& ruled_out_in(std::size_t group) const {
    if (!has_ruled_out) {
      return kNothingRuledOut;
    }
    return ruled_out[group];
  }

  // Row by row from the lowest y, and so is all that is by group.
  alignas(32) std::array<evidence::Free, kGroupsPerTile> free{};
  std::array<evidence::Taken, kGroupsPerTile> taken{};
  // Apart from the masses: whoever sends the classes reads nothing else.
  std::array<decision::Decided, kGroupsPerTile> decided{};
  // What the map rules out, whether something is known or not: 0 where nobody knows the map.
  TileRuledOut ruled_out{};
  // By group the clock's slots of its last ageing and of its last evidence (ageing/clock.hpp). Both
  // are none where nothing is known, the second also where the last evidence is long ago.
  std::array<std::uint8_t, kGroupsPerTile> aged_at{};
  std::array<std::uint8_t, kGroupsPerTile> evidence_at{};
  // Whether the group is known and `taken` of it all zeros.
  std::array<bool, kGroupsPerTile> is_free_alone{};
  Found found{};
  Ground ground{};
  // Whether `ruled_out` is not 0 somewhere.
  bool has_ruled_out = false;
  // A beam that was low has freed the cell since the tile is known, and nothing stood there since.
  Plane from_below{};
};

inline void Tile::clear() {
  aged_at.fill(ageing::Clock::kNever);
  evidence_at.fill(ageing::Clock::kNever);
  is_free_alone.fill(false);
  decided.fill({});
  found = {};
  ground = {};
  from_below = {};
}

}  // namespace iog::window
