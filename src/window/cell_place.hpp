// Where a cell of the local frame lies in the window's memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include "geometry/cell.hpp"
#include "window/area.hpp"
#include "window/tile.hpp"

namespace iog::window {

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
