// How long the serial link takes to go once round the grid, and how many bytes that is.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "tools/frames/grid_frame.hpp"

namespace iog::lab {

// Of one of the line's grids: the rough, the fine, the cells.
struct SerialRounds {
  std::uint64_t bytes = 0;  // on the line, framed, of whole rounds
  std::uint32_t rounds = 0;
  std::uint64_t first_us = 0;  // the beginning of the first round
  std::uint64_t last_us = 0;   // and that of the one behind the last
};

// Lets these frames come one after the other, again and again, 25 a second, for a minute, and a
// pass of the loop every millisecond. By the side of a grid's cells, mm.
[[nodiscard]] std::map<std::uint16_t, SerialRounds> serial_rounds(
    const std::vector<tools::GridFrame>& frames, std::uint32_t bytes_per_second);

}  // namespace iog::lab
