// traversal_cost: instructions for going from cell to cell on the Cortex-A9, for the walk of the
// product and for those it is compared with (thesis table 4.2). Runs in QEMU with instruction
// counting (lab/target/run_image); prints a line of key=value pairs for each walk.
#include <cstdio>

#include "fan.hpp"
#include "instruction_counter.hpp"
#include "walk_cost.hpp"

namespace iog::lab {
namespace {

int run() {
  static InstructionCounter counter;
  counter.start();
  if (!counter.is_exact()) {
    std::puts("traversal_cost: instructions are not counted; is this -icount shift=4,sleep=off?");
    return 1;
  }
  for (const WalkCost& cost : measure_walks(counter)) {
    // cppcheck-suppress invalidPrintfArgType_uint ; on a PC it would be unsigned int
    std::printf(
        "traversal_cost walk=%s beams=%u cells=%lu setup_instructions=%lu instructions=%lu\n",
        cost.walk, kBeamCount, cost.cells, cost.setup, cost.carving);
  }
  return 0;
}

}  // namespace
}  // namespace iog::lab

int main() { return iog::lab::run(); }
