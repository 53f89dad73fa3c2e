// Finds the hits in a band of a tile. `hit_eights.cpp` is the reference implementation. CMake
// selects either hit_eights.cpp or hit_eights_neon.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lanes/eight_bytes.hpp"
#include "placing/slice_cells.hpp"

namespace iog::placing {

// The number of groups of eight cells in a row of a tile, and in a band of eight rows.
inline constexpr std::size_t kEightsPerRow = geometry::kTileSide / lanes::EightBytes::kCount;
inline constexpr std::size_t kEightsPerBand = SliceCells::kBlockSide * kEightsPerRow;
static_assert(kEightsPerBand == 32, "a bit each");

// `band` contains eight rows in the layout of SliceCells. Bit i of the result is set if any of the
// eight cells that start at byte 8 * i is hit.
[[nodiscard]] std::uint32_t hit_eights(const std::int8_t* band);

}  // namespace iog::placing
