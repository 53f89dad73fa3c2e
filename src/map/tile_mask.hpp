// Defines which classes the map allows in each cell of a tile.
#pragma once

#include "window/tile.hpp"

namespace iog::map {

// For each class of the map, contains the cells that may have this class. At least one class must
// be allowed in each cell.
struct TileMask {
  window::Plane building{};
  window::Plane road{};
  window::Plane intermediate{};
  friend bool operator==(const TileMask&, const TileMask&) = default;
};

// Converts a mask to the input format of decision::decide().
void rule_out(const TileMask& mask, window::TileRuledOut& to);

}  // namespace iog::map
