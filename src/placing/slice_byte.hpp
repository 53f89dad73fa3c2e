// The byte of a cell in a slice or in a frame's evidence. The byte contains an occupancy index and
// an extra bit.
//
//     `0`          The cell is unknown.
//     `n`          The cell is hit, with an index n from 1 to 31.
//     `n + 32`     The same as n, and the return is at least as high as the sensor's tall_mm.
//     `-n`         The cell is free, with index -n.
//     `-(n + 32)`  The same as -n, and the cell was freed by a beam that was at most as high as the
//                  sensor's low_mm.
//
// Indexes above 31 are clamped to 31 because masses do not increase beyond this index
// (evidence/assignment.hpp). Sums can therefore saturate at 31 instead of 127, which leaves room in
// the byte for the extra bit.
#pragma once

#include <algorithm>
#include <cstdint>

#include "evidence/assignment.hpp"
#include "window/tile.hpp"

namespace iog::placing {

inline constexpr std::int32_t kMostIndex = evidence::kGradedIndexes - 1;
inline constexpr std::int32_t kBeside = 32;
static_assert(kMostIndex == kBeside - 1);

// Returns the index stored in a byte, without the extra bit.
[[nodiscard]] constexpr std::int32_t index_of(std::int8_t byte) {
  return byte < 0 ? -(-byte & kMostIndex) : byte & kMostIndex;
}

// `has_bit` is the extra bit of a free or hit cell.
[[nodiscard]] constexpr std::int8_t byte_of(std::int32_t index, bool has_bit) {
  const std::int32_t most = std::clamp(index, -kMostIndex, kMostIndex);
  const std::int32_t beside = index != 0 && has_bit ? kBeside : 0;
  return static_cast<std::int8_t>(index < 0 ? most - beside : most + beside);
}

// Adds the free index of another slice to a cell's evidence. The indexes are added, and the extra
// bit is set if it is set in either byte. Positive evidence comes from hits and does not change.
// Hits in `found` are ignored.
[[nodiscard]] constexpr std::int8_t joined_free(std::int8_t evidence, std::int8_t found) {
  if (evidence > 0 || found >= 0) {
    return evidence;
  }
  return byte_of(index_of(evidence) + index_of(found),
                 evidence < -kMostIndex || found < -kMostIndex);
}

[[nodiscard]] constexpr bool is_tall(std::int8_t byte) { return byte > kMostIndex; }
[[nodiscard]] constexpr bool is_from_below(std::int8_t byte) { return byte < -kMostIndex; }

}  // namespace iog::placing
