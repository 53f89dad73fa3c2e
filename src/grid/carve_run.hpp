// The loop that carving spends its time in: blocks of a path, one after the other, by the same
// amount.
#pragma once

#include <cstddef>
#include <cstdint>

#include "grid/block_path.hpp"
#include "grid/lanes.hpp"

namespace iog::grid {

// Makes those cells of a block freer by the amounts.
inline void carve_block(LaneBytes& block, Lanes cells, Lanes amount) {
  Lanes::load(block).subtract(amount.bit_and(cells)).store(block);
}

// A way through blocks: where it is, the code of that block, and the codes of the next.
struct Way {
  BlockRun run;
  LaneBytes* block;
  std::uint32_t code;
  const BlockCode* next_codes;

  // The block after this one. Both candidates first, so that nothing waits for the code but the
  // choice.
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

// The next `count` blocks of the way.
inline void carve_one_by_one(Way& way, std::uint32_t count, Lanes amount) {
  Way here = way;  // in registers: a block is stored where the compiler suspects a member
  for (; count > 0; --count) {
    here.step();
    carve_block(*here.block, Lanes::load(here.run.masks[here.code / 2U]), amount);
  }
  way = here;
}

// The same: the machine's own, a file that CMake chooses.
void carve_run(Way& way, std::uint32_t count, Lanes amount);

}  // namespace iog::grid
