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
  Lanes::load(block).subtract(amount.masked(cells)).store(block);
}

// A way through blocks: where it is, the code of that block, and the codes of the next.
struct Way {
  BlockRun run;
  LaneBytes* block;
  std::uint32_t code;
  const BlockCode* next_codes;

  // From this block to the next, in blocks as stored.
  [[nodiscard]] std::ptrdiff_t stride() const {
    return (code & 1U) != 0 ? run.v_stride : run.u_stride;
  }
  void step() {
    block += stride();
    code = *next_codes;
    ++next_codes;
  }
};

// The next `count` blocks of the way.
inline void carve_one_by_one(Way& way, std::uint32_t count, Lanes amount) {
  for (; count > 0; --count) {
    way.step();
    carve_block(*way.block, Lanes::load(way.run.masks[way.code / 2U]), amount);
  }
}

// The same: the machine's own, a file that CMake chooses.
void carve_run(Way& way, std::uint32_t count, Lanes amount);

}  // namespace iog::grid
