// Blurs a bit plane: the union over a disc.
#pragma once

#include <cstdint>

#include "map/raster.hpp"
#include "window/tile.hpp"

namespace iog::map {

// The cells of the tile with a set bit within `radius` cells, from centre to centre. radius: 0 ...
// kHalo. Only rows within the radius are read.
[[nodiscard]] window::Plane blurred(const FrameBits& bits, std::int32_t radius);

}  // namespace iog::map
