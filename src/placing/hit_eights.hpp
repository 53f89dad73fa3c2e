// Finds the hits in a band of a tile. hit_eights.cpp is the reference; CMake selects it or
// hit_eights_neon.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "lanes/eight_bytes.hpp"
#include "placing/slice_cells.hpp"

namespace iog::placing {

// Groups of eight cells in a row of a tile, and in a band of eight rows.
inline constexpr std::size_t kEightsPerRow = geometry::kTileSide / lanes::EightBytes::kCount;
inline constexpr std::size_t kEightsPerBand = SliceCells::kBlockSide * kEightsPerRow;
static_assert(kEightsPerBand == 32, "a bit each");

// band: eight rows as SliceCells stores them. Bit i is set if one of the eight cells from byte 8 i
// on is hit.
[[nodiscard]] std::uint32_t hit_eights(const std::int8_t* band);

}  // namespace iog::placing
