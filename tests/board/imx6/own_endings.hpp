// How to end a firmware on the Cortex-A9, in assembly, because the compiler would know better than
// to do any of this.
#pragma once

#include <cstdint>

#include "board.hpp"

namespace iog::tests {

inline void read(std::uintptr_t address) {
  __asm__ volatile("ldr r0, [%0]" ::"r"(address) : "r0", "memory");
}

inline void call(std::uintptr_t address) {
  __asm__ volatile("blx %0" ::"r"(address) : "r0", "r1", "r2", "r3", "ip", "lr", "memory");
}

inline void take_an_interrupt(board::Board& board) {
  board.clock().wait_us(2000);  // the tick is pending by now
  __asm__ volatile("cpsie i");
}

// An asynchronous abort as the processor takes one (ARM ARM, B1.9.8), which QEMU has none of: the
// fault status is that of an external one, and Abort mode is entered at its vector.
inline void abort_asynchronously() {
  __asm__ volatile(
      "movw r0, #0x406\n\t"
      "mcr p15, 0, r0, c5, c0, 0\n\t"
      "mrs r0, cpsr\n\t"
      "mov r1, pc\n\t"
      "cpsid aif, #0x17\n\t"
      "msr spsr_cxsf, r0\n\t"
      "mov lr, r1\n\t"
      "mrc p15, 0, r0, c12, c0, 0\n\t"
      "add pc, r0, #0x10" ::
          : "r0", "r1", "memory");
}

// The ends that this board has beside the common ones, from 0. Returns if there is none.
inline void end_in_own_way(std::uint32_t number, board::Board& board) {
  if (number == 0) {
    abort_asynchronously();
  }
  if (number == 1 || number == 2) {
    board.console().write(number == 1 ? "silence\n" : "silence without interrupts\n");
    if (number == 2) {
      __asm__ volatile("cpsid f");
    }
    for (;;) {
      board.idle();
    }
  }
}

}  // namespace iog::tests
