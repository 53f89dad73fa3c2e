// The hot loop of carving, which carves consecutive blocks of a path by the same amount.
#pragma once

#include <cstddef>
#include <cstdint>

#include "grid/block_path.hpp"
#include "lanes/lanes.hpp"

namespace iog::grid {

// Subtracts `amount` from the given cells of a block.
inline void carve_block(LaneBytes& block, Lanes cells, Lanes amount) {
  Lanes::load(block).subtract(amount.bit_and(cells)).store(block);
}

// Carves the next `count` blocks of the path.
inline void carve_one_by_one(Way& way, std::uint32_t count, Lanes amount) {
  Way here = way;  // a local copy in registers, because a block might alias a member
  for (; count > 0; --count) {
    here.step();
    carve_block(*here.block, Lanes::load(here.cells()), amount);
  }
  way = here;
}

// An optimised version of carve_one_by_one(). CMake selects the source file.
void carve_run(Way& way, std::uint32_t count, Lanes amount);

}  // namespace iog::grid
