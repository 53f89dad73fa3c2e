// What is possible in a cell because it is the case near by: the union over a disc.
#pragma once

#include <cstdint>

#include "map/raster.hpp"
#include "window/tile.hpp"

namespace iog::map {

// The tile's cells that have one of `bits` within so many cells, centre to centre, 0 ... kHalo.
// Only the rows that are so far away are looked at.
[[nodiscard]] window::Plane blurred(const FrameBits& bits, std::int32_t radius);

}  // namespace iog::map
