// Maps of simulated scenes as the target has them: drawn with or without errors, written as
// OpenStreetMap, and made a block by what `iog map` does.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/simulate/maps/drawn_map.hpp"
#include "tools/simulate/world/map_place.hpp"

namespace iog::lab {

// accuracy_mm: what the block says of itself. tools::UsageError if no block can be made of it.
[[nodiscard]] std::vector<std::uint8_t> block_of(const tools::DrawnMap& map,
                                                 const tools::MapPlace& place,
                                                 std::uint32_t accuracy_mm);

}  // namespace iog::lab
