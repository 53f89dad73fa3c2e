// Tiles of a grid, by their numbers in messages.
#pragma once

#include <bitset>

#include "geometry/grid.hpp"

namespace iog::tools {

using TileSet = std::bitset<geometry::kTileCount>;

}  // namespace iog::tools
