// The loop in which carving spends its time: one block of a path after the other, all by the same
// amount.
#pragma once

#include <cstddef>
#include <cstdint>

#include "grid/block_path.hpp"
#include "grid/lanes.hpp"

namespace iog::grid {

// Makes these cells of a block freer by the amounts.
inline void carve_block(LaneBytes& block, Lanes cells, Lanes amount) {
  Lanes::load(block).subtract(amount.bit_and(cells)).store(block);
}

// A place on the way through the blocks of a line: the block, its code, and the codes of the blocks
// after it.
struct Way {
  BlockRun run;
  LaneBytes* block;
  std::uint32_t code;
  const BlockCode* next_codes;

  // The block after this one. Both candidates are computed first, so that only the choice waits for
  // the code.
  [[nodiscard]] LaneBytes* next() const {
    LaneBytes* const by_u = block + run.u_stride;
    LaneBytes* const by_v = block + run.v_stride;
    return (code & 1U) != 0 ? by_v : by_u;
  }
  void step() {
    block = next();
    code = *next_codes;
    ++next_codes;
  }
};

// Carves the next `count` blocks of the way.
inline void carve_one_by_one(Way& way, std::uint32_t count, Lanes amount) {
  Way here = way;  // in registers: a block is stored where the compiler suspects a member
  for (; count > 0; --count) {
    here.step();
    carve_block(*here.block, Lanes::load(here.run.masks[here.code / 2U]), amount);
  }
  way = here;
}

// Does the same as fast as the machine can; CMake chooses the file.
void carve_run(Way& way, std::uint32_t count, Lanes amount);

}  // namespace iog::grid
