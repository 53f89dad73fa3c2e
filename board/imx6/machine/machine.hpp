// Contains all accesses to the machine: single loads and stores of device registers and DMA
// descriptors, copies from DMA buffers, barriers, and sleep. Tests on a PC use another file with
// the same name (tests/host/fakes/machine.hpp), which records the same calls. CMake selects the
// file.
#pragma once

#include <cstddef>
#include <cstdint>

#include "machine_of_arm.hpp"

// Makes the code that boards share visible in this namespace.
namespace iog::board {}
namespace iog::imx6 {
using namespace board;  // NOLINT(google-build-using-namespace): shared parts
}

namespace iog::machine {

inline constexpr std::size_t kBurstBytes = 32;

// Copies `bursts` times kBurstBytes. `bursts` must be at least 1, and both addresses must be
// aligned to 8 bytes. From uncached memory, an LDM is one bus burst of up to nine times 64 bits
// (Cortex-A9 TRM, ARM DDI 0388I, 8.1.2), whereas each load of a single field is a separate DDR
// access.
inline void copy_bursts(std::byte* to, const std::byte* from, std::size_t bursts) {
  __asm__ volatile(
      "1: ldmia %[from]!, {r4, r5, r6, r7, r8, r9, r10, r12}\n\t"
      "subs %[bursts], %[bursts], #1\n\t"
      "stmia %[to]!, {r4, r5, r6, r7, r8, r9, r10, r12}\n\t"
      "bne 1b"
      : [to] "+r"(to), [from] "+r"(from), [bursts] "+r"(bursts)
      :
      : "r4", "r5", "r6", "r7", "r8", "r9", "r10", "r12", "cc", "memory");
}

inline void mask_interrupts() { __asm__ volatile("cpsid i" ::: "memory"); }
inline void unmask_interrupts() { __asm__ volatile("cpsie i\n\tisb" ::: "memory"); }

// Returns the number of this core, from MPIDR.
inline std::size_t core_number() {
  std::uint32_t mpidr = 0;
  __asm__("mrc p15, 0, %0, c0, c0, 5" : "=r"(mpidr));
  return mpidr & 3;
}

}  // namespace iog::machine
