// The loop in which carving spends its time: one block of a path after the other, all by the same
// amount.
#pragma once

#include <cstddef>
#include <cstdint>

#include "grid/block_path.hpp"
#include "lanes/lanes.hpp"

namespace iog::grid {

// Makes these cells of a block freer by the amounts.
inline void carve_block(LaneBytes& block, Lanes cells, Lanes amount) {
  Lanes::load(block).subtract(amount.bit_and(cells)).store(block);
}

// Carves the next `count` blocks of the way.
inline void carve_one_by_one(Way& way, std::uint32_t count, Lanes amount) {
  Way here = way;  // in registers: a block is stored where the compiler suspects a member
  for (; count > 0; --count) {
    here.step();
    carve_block(*here.block, Lanes::load(here.cells()), amount);
  }
  way = here;
}

// Does the same as fast as the machine can; CMake chooses the file.
void carve_run(Way& way, std::uint32_t count, Lanes amount);

}  // namespace iog::grid
