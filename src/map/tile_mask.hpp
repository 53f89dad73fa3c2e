// Defines the classes that the map allows in the cells of a tile.
#pragma once

#include "window/tile.hpp"

namespace iog::map {

// Contains, for each class of the map, the cells that may have this class. Each cell must be
// allowed at least one class.
struct TileMask {
  window::Plane building{};
  window::Plane road{};
  window::Plane intermediate{};
  friend bool operator==(const TileMask&, const TileMask&) = default;
};

// Converts a mask to the input format of decision::decide().
void rule_out(const TileMask& mask, window::TileRuledOut& to);

}  // namespace iog::map
