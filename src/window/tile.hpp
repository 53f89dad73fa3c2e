// The memory of one tile of the window: 32 by 32 cells, aligned with the local frame.
//
// A cleared tile contains only zeros, with two exceptions. First, clearing does not write the
// masses, so the masses of a group are undefined until it is aged. Second, the classes ruled out by
// the map are kept.
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

// A plane has one bit per cell. Bit x of word y represents cell (x, y). Word 0 has the lowest y.
using Plane = std::array<std::uint32_t, geometry::kTileSide>;
static_assert(geometry::kTileSide == 32);

// Returns true if no bit of the plane is set. Reading all words is faster than testing each word.
[[nodiscard]] inline bool is_empty(const Plane& plane) {
  std::uint32_t bits = 0;
  for (const std::uint32_t row : plane) {
    bits |= row;
  }
  return bits == 0;
}

// The classes that the map rules out in a tile, row by row from the lowest y.
using TileRuledOut = std::array<decision::RuledOut, kGroupsPerTile>;
alignas(8) inline constexpr std::array<decision::RuledOut, kGroupsPerRow> kNothingRuledOut{};

// Cell properties for later neighbourhood tests. These properties are computed whenever the cell's
// group is classified.
struct Found {
  Plane freed{};   // free mass above one half
  Plane seen{};    // free according to evidence of the same frame
  Plane stands{};  // occupied for a long time
  Plane taken{};   // occupied mass above one quarter
};

// The memory of the ground. It is not affected by objects that are currently on the ground.
struct Ground {
  Plane open{};       // the ground was free, with a margin
  Plane dense{};      // all surrounding cells were seen as free in one frame
  Plane ticks_low{};  // 0 ... 3: number of times that it was found open again
  Plane ticks_high{};
};

struct Tile {
  // Sets all cells to unknown.
  void clear();

  // Returns true if the group has become known since the tile was last cleared.
  [[nodiscard]] bool is_known(std::size_t group) const {
    return aged_at[group] != ageing::Clock::kNever;
  }

  // Returns the classes that the map rules out in a group. The remaining groups of the same row
  // follow in memory. If the target has no map, this function avoids reading a kilobyte of zeros.
  [[nodiscard]] const decision::RuledOut& ruled_out_in(std::size_t group) const {
    if (!has_ruled_out) {
      return kNothingRuledOut[group % kGroupsPerRow];
    }
    return ruled_out[group];
  }

  // Like all arrays indexed by group, the masses are stored row by row from the lowest y.
  alignas(32) std::array<evidence::Free, kGroupsPerTile> free{};
  std::array<evidence::Taken, kGroupsPerTile> taken{};
  // The class bytes are stored separately from the masses, which are not needed when classes are
  // sent.
  std::array<decision::Decided, kGroupsPerTile> decided{};
  // The classes that the map rules out, even for unknown cells. The value is 0 where the map has no
  // information.
  TileRuledOut ruled_out{};
  // For each group, the clock slots (ageing/clock.hpp) of the frames in which it was last aged and
  // last received evidence. Both slots are kNever if the group is unknown. If the last evidence is
  // too old, its slot is also kNever.
  std::array<std::uint8_t, kGroupsPerTile> aged_at{};
  std::array<std::uint8_t, kGroupsPerTile> evidence_at{};
  // True if the group is known and all of its `taken` values are 0.
  std::array<bool, kGroupsPerTile> is_free_alone{};
  Found found{};
  Ground ground{};
  // True if `ruled_out` contains a non-zero value.
  bool has_ruled_out = false;
  // A cell's bit is set if a low beam has freed the cell since the tile became known and no
  // stationary object has been in the cell since then.
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

// Describes where the window stores a cell of the local frame.
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

// Returns the coordinates of a cell in the local frame. `i` is the cell's index in the group, and
// `group` is the group's index in the tile at `slot`.
[[nodiscard]] constexpr geometry::Cell cell_at(const Area& area, std::size_t slot,
                                               std::size_t group, std::size_t i) {
  const TileNumber tile = area.tile_at(slot);
  const std::size_t x = group % kGroupsPerRow * evidence::kGroupCells + i;
  return {tile.a * kTileSide + static_cast<std::int32_t>(x),
          tile.b * kTileSide + static_cast<std::int32_t>(group / kGroupsPerRow)};
}

}  // namespace iog::window
