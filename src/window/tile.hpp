// One tile of the window in memory: 32 by 32 cells aligned to the local frame.
//
// An unknown tile is all zeros, with two exceptions. Groups that were never aged have undefined
// masses, so clearing a tile does not write all of it. The map's content stays.
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

// One bit per cell: bit x of word y, y from the lowest.
using Plane = std::array<std::uint32_t, geometry::kTileSide>;
static_assert(geometry::kTileSide == 32);

// Whether the plane is empty. Reading all words is faster than testing each.
[[nodiscard]] inline bool is_empty(const Plane& plane) {
  std::uint32_t bits = 0;
  for (const std::uint32_t row : plane) {
    bits |= row;
  }
  return bits == 0;
}

// The map classes ruled out in a tile, row by row from the lowest y.
using TileRuledOut = std::array<decision::RuledOut, kGroupsPerTile>;
alignas(8) inline constexpr decision::RuledOut kNothingRuledOut{};

// Properties that later neighbourhood tests need, as found when the cell's group was last decided.
struct Found {
  Plane freed{};   // more free than not
  Plane seen{};    // free by evidence of that same frame
  Plane stands{};  // occupied for a long time
  Plane taken{};   // occupied at all
};

// Memory of the ground, independent of what is on it now.
struct Ground {
  Plane open{};       // it was free, with a margin
  Plane dense{};      // all cells around were seen free in one frame
  Plane ticks_low{};  // 0 ... 3: how often it was found open again
  Plane ticks_high{};
};

struct Tile {
  // Sets all cells to unknown.
  void clear();

  // Whether the group was ever known.
  [[nodiscard]] bool is_known(std::size_t group) const {
    return aged_at[group] != ageing::Clock::kNever;
  }

  // The map classes ruled out in a group. Without a map this avoids reading a kilobyte of zeros.
  [[nodiscard]] const decision::RuledOut& ruled_out_in(std::size_t group) const {
    if (!has_ruled_out) {
      return kNothingRuledOut;
    }
    return ruled_out[group];
  }

  // Row by row from the lowest y, like all arrays by group.
  alignas(32) std::array<evidence::Free, kGroupsPerTile> free{};
  std::array<evidence::Taken, kGroupsPerTile> taken{};
  // Separate from the masses, because sending the classes reads nothing else.
  std::array<decision::Decided, kGroupsPerTile> decided{};
  // The map classes ruled out, even for unknown cells. 0 where the map says nothing.
  TileRuledOut ruled_out{};
  // For each group, the clock's slots of its last ageing and of its last evidence
  // (ageing/clock.hpp). Both are kNever if the group is unknown. The second is also kNever if the
  // last evidence is long ago.
  std::array<std::uint8_t, kGroupsPerTile> aged_at{};
  std::array<std::uint8_t, kGroupsPerTile> evidence_at{};
  // Whether the group is known and its `taken` is all zeros.
  std::array<bool, kGroupsPerTile> is_free_alone{};
  Found found{};
  Ground ground{};
  // Whether `ruled_out` has a value other than 0.
  bool has_ruled_out = false;
  // A low beam has freed the cell since the tile became known, and nothing has stood there since.
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

// Location of a cell of the local frame in the window's memory.
struct CellPlace {
  std::size_t slot = 0;
  std::uint32_t x = 0;  // within the tile
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

// Cell i of a group of the tile at a slot.
[[nodiscard]] constexpr geometry::Cell cell_at(const Area& area, std::size_t slot,
                                               std::size_t group, std::size_t i) {
  const TileNumber tile = area.tile_at(slot);
  const std::size_t x = group % kGroupsPerRow * evidence::kGroupCells + i;
  return {tile.a * kTileSide + static_cast<std::int32_t>(x),
          tile.b * kTileSide + static_cast<std::int32_t>(group / kGroupsPerRow)};
}

}  // namespace iog::window
