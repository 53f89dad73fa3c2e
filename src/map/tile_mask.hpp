// What the map says of a tile's cells.
#pragma once

#include "window/tile.hpp"

namespace iog::map {

// By class of the map, in which cells it is possible. A cell has at least one.
struct TileMask {
  window::Plane building{};
  window::Plane road{};
  window::Plane intermediate{};
  friend bool operator==(const TileMask&, const TileMask&) = default;
};

// The same as decision::decide() takes it.
void rule_out(const TileMask& mask, window::TileRuledOut& to);

}  // namespace iog::map
