// Brings parts of a tile to the cache that are needed soon.
#pragma once

#include <cstddef>
#include <span>

#include "lanes/bring.hpp"
#include "window/tile.hpp"

namespace iog::perception {

// Asks for the lines of a group that is needed soon.
inline void prefetch(const window::Tile& tile, std::size_t group) {
  __builtin_prefetch(&tile.free[group]);
  if (!tile.is_free_alone[group]) {
    __builtin_prefetch(&tile.taken[group].occupied);
    __builtin_prefetch(&tile.taken[group].standing);
  }
}

// Brings the small things of some rows of a tile to the cache. Then the lines of its masses follow
// one another, and nothing comes between them.
inline void bring_rows(const window::Tile& tile, std::size_t first, std::size_t last) {
  const std::size_t count = (last - first + 1) * window::kGroupsPerRow;
  lanes::bring(
      std::as_bytes(std::span(tile.decided).subspan(first * window::kGroupsPerRow, count)));
  if (tile.has_ruled_out) {
    lanes::bring(
        std::as_bytes(std::span(tile.ruled_out).subspan(first * window::kGroupsPerRow, count)));
  }
  lanes::bring(std::as_bytes(std::span(tile.aged_at)));
  lanes::bring(std::as_bytes(std::span(tile.evidence_at)));
  lanes::bring(std::as_bytes(std::span(tile.is_free_alone)));
  lanes::bring(std::as_bytes(std::span(&tile.found, 1)));
}

}  // namespace iog::perception
