// What a byte says of a cell of a slice, and of a cell of a frame's evidence: an occupancy index,
// and one bit beside it.
//
//     0             nothing is said
//     n, 1 ... 31   hit, by the index n
//     n + 32        the same, and the return is at least as high as the sensor's tall_mm
//     -n            free, by the index -n
//     -(n + 32)     the same, and a beam that freed it was at most as high as the sensor's low_mm
//
// An index beyond 31 counts as 31: no mass grows behind it (evidence/assignment.hpp). So sums that
// saturate at 31 are as good as those that saturate at 127, and a byte has room for the bit.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "evidence/assignment.hpp"
#include "window/tile.hpp"

namespace iog::placing {

inline constexpr std::int32_t kMostIndex = evidence::kGradedIndexes - 1;
inline constexpr std::int32_t kBeside = 32;
static_assert(kMostIndex == kBeside - 1);

// The index of a byte, without the bit.
[[nodiscard]] constexpr std::int32_t index_of(std::int8_t byte) {
  return byte < 0 ? -(-byte & kMostIndex) : byte & kMostIndex;
}

// has_bit: of a cell that is free or hit, what is said of it beside its index.
[[nodiscard]] constexpr std::int8_t byte_of(std::int32_t index, bool has_bit) {
  const std::int32_t most = std::clamp(index, -kMostIndex, kMostIndex);
  const std::int32_t beside = index != 0 && has_bit ? kBeside : 0;
  return static_cast<std::int8_t>(index < 0 ? most - beside : most + beside);
}

// What is said of a cell that one more slice frees, or does not: free indexes are added, and a bit
// stays. What is above 0 counts hits, and no beam changes it; of `found` it says nothing of free.
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
