// Blurs a bit plane, that is, dilates the plane by a disc.
#pragma once

#include <cstdint>

#include "map/raster.hpp"
#include "window/tile.hpp"

namespace iog::map {

// Returns the cells of the tile that have a set bit within `radius` cells, measured from centre to
// centre. `radius` is 0 ... kHalo. Only rows within the radius are read.
[[nodiscard]] window::Plane blurred(const FrameBits& bits, std::int32_t radius);

}  // namespace iog::map
