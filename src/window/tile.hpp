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
#include "geometry/cell.hpp"
#include "geometry/tile.hpp"
#include "window/area.hpp"

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

// Where a cell of the local frame lies in the window's memory.
struct CellPlace {
  std::size_t slot = 0;
  std::uint32_t x = 0;  // in its tile
  std::uint32_t y = 0;

  [[nodiscard]] constexpr std::size_t group() const {
    return y * kGroupsPerRow + x / evidence::kGroupCells;
  }
  [[nodiscard]] constexpr std::size_t in_group() const { return x % evidence::kGroupCells; }
  [[nodiscard]] constexpr bool is_in(const Plane& plane) const { return (plane[y] >> x & 1U) != 0; }
};

[[nodiscard]] constexpr CellPlace place_of(geometry::Cell cell) {
  constexpr std::uint32_t kInTile = kTileSide - 1;
  return {.slot = slot_of(window_tile(cell)),
          .x = static_cast<std::uint32_t>(cell.x) & kInTile,
          .y = static_cast<std::uint32_t>(cell.y) & kInTile};
}

// The cell i of a group of the tile at a slot.
[[nodiscard]] constexpr geometry::Cell cell_at(const Area& area, std::size_t slot,
                                               std::size_t group, std::size_t i) {
  const TileNumber tile = area.tile_at(slot);
  const std::size_t x = group % kGroupsPerRow * evidence::kGroupCells + i;
  return {tile.a * kTileSide + static_cast<std::int32_t>(x),
          tile.b * kTileSide + static_cast<std::int32_t>(group / kGroupsPerRow)};
}

}  // namespace iog::window
