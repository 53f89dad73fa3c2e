// Selects the interrupts that the GIC passes to core 0 (ARM IHI 0048). All boards use these
// functions.
#pragma once

#include <cstdint>

#include "registers/gic_of.hpp"

namespace iog::board {

// The priority of all interrupts, which only has to be more urgent than the mask 0xff.
inline constexpr std::uint8_t kInterruptPriority = 0xa0;

// Switches the GIC off, disables all lines, and makes all lines level-sensitive. A boot loader may
// have left lines enabled and edges pending.
template <typename Distributor>
void clear_lines(Distributor& distributor, GicCpuRegisters& cpu) {
  distributor.ctlr.write(0);
  cpu.ctlr.write(0);
  for (Rw32& word : distributor.icenabler) {
    word.write(0xffff'ffff);
  }
  for (Rw32& word : distributor.icpendr) {
    word.write(0xffff'ffff);
  }
  for (unsigned word = 2; word < Distributor::kInterrupts / 16; ++word) {
    distributor.icfgr[word].write(0);  // words 0 and 1 are the private interrupts, fixed
  }
}

template <typename Distributor>
void let_through(Distributor& distributor, unsigned interrupt,
                 std::uint8_t priority = kInterruptPriority) {
  constexpr std::uint8_t kCore0 = 1u << 0;
  distributor.ipriorityr[interrupt].write(priority);
  distributor.itargetsr[interrupt].write(kCore0);
  distributor.isenabler[interrupt / 32].write(1u << (interrupt % 32));
}

}  // namespace iog::board
