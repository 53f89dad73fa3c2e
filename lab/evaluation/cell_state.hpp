// What a cell is, in truth or by the word of a grid.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace iog::lab {

enum class CellState : std::uint8_t { kUnknown, kFree, kOccupied };

// Below 0 free, above occupied.
[[nodiscard]] std::vector<CellState> states_of(std::span<const std::int32_t> indexes);

// Below 1/2 free, above occupied; unknown within `margin` of it. An inverse sensor model in double
// precision is never quite 1/2 behind its scan point (1/2 + 1e-9 and the like), which says nothing.
[[nodiscard]] std::vector<CellState> states_of(std::span<const double> probabilities,
                                               double margin);

}  // namespace iog::lab
