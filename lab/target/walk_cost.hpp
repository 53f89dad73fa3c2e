// What it costs to walk the fan, by way of walking.
#pragma once

#include <array>
#include <cstdint>

#include "instruction_counter.hpp"

namespace iog::lab {

struct WalkCost {
  const char* walk;       // "discrete r=20"
  std::uint32_t setup;    // instructions for all beams, from their ends to their first cells
  std::uint32_t carving;  // instructions for all beams, from cell to cell, carving each
  std::uint32_t cells;    // visited; the sensor's own counts for each beam
};

inline constexpr std::size_t kWalkCount = 8;

// Not twice: the grid is not cleared between the walks. That costs nothing: what is done at a cell
// is the same for every value in it.
[[nodiscard]] std::array<WalkCost, kWalkCount> measure_walks(InstructionCounter& counter);

}  // namespace iog::lab
