// Blurs a bit plane by dilating it with a disc.
#pragma once

#include <cstdint>

#include "map/raster.hpp"
#include "window/tile.hpp"

namespace iog::map {

// Returns the tile's cells that are at most `radius` cells away from a set bit. Distances are
// measured between the centres of cells. `radius` is 0 ... kHalo. The function reads only the rows
// within `radius` of the tile.
[[nodiscard]] window::Plane blurred(const FrameBits& bits, std::int32_t radius);

}  // namespace iog::map
