// How to end a firmware on the Cortex-A53, in assembly, because the compiler would know better than
// to do any of this.
#pragma once

#include <cstdint>

#include "board.hpp"

namespace iog::tests {

inline void read(std::uintptr_t address) {
  __asm__ volatile("ldr x0, [%0]" ::"r"(address) : "x0", "memory");
}

inline void call(std::uintptr_t address) {
  __asm__ volatile("blr %0" ::"r"(address) : "x0", "x1", "x2", "x3", "x30", "memory");
}

inline void take_an_interrupt(board::Board& /*board*/) {
  machine::alarm_in(1);
  __asm__ volatile("msr daifclr, #2\n\tisb");
}

// The ends that this board has beside the common ones, from 0. Returns if there is none.
inline void end_in_own_way(std::uint32_t number, board::Board& /*board*/) {
  if (number == 0) {
    call(reinterpret_cast<std::uintptr_t>(&call) + 1);  // no place of an instruction
  }
  if (number == 1) {
    read(std::uintptr_t{1} << 40);  // behind all that is mapped
  }
}

}  // namespace iog::tests
