// Contains all accesses to the machine: single loads and stores of device registers and DMA
// descriptors, barriers, sleep, and calls of the platform firmware. Tests on a PC use another file
// with the same name (tests/host/fakes/machine.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "machine_of_arm.hpp"

// Makes the code that boards share visible in this namespace.
namespace iog::board {}
namespace iog::zcu102 {
using namespace board;  // NOLINT(google-build-using-namespace): shared parts
}

namespace iog::machine {

inline constexpr std::size_t kBurstBytes = 64;  // a cache line

// Copies `bursts` times kBurstBytes. `bursts` must be at least 1.
inline void copy_bursts(std::byte* to, const std::byte* from, std::size_t bursts) {
  std::memcpy(to, from, bursts * kBurstBytes);
}

inline void mask_interrupts() { __asm__ volatile("msr daifset, #2" ::: "memory"); }
inline void unmask_interrupts() { __asm__ volatile("msr daifclr, #2\n\tisb" ::: "memory"); }

// Returns the number of this core, from MPIDR_EL1.
inline std::size_t core_number() {
  std::uint64_t mpidr = 0;
  __asm__("mrs %0, mpidr_el1" : "=r"(mpidr));
  return mpidr & 0xff;
}

// These functions read the generic timer (ARM ARM, D11). The counter is read after all earlier
// instructions. The boot loader has set the frequency.
inline std::uint64_t counter() {
  std::uint64_t ticks = 0;
  __asm__ volatile("isb\n\tmrs %0, cntpct_el0" : "=r"(ticks)::"memory");
  return ticks;
}
inline std::uint64_t counter_hz() {
  std::uint64_t hz = 0;
  __asm__ volatile("mrs %0, cntfrq_el0" : "=r"(hz));
  return hz;
}

// alarm_in() requests the timer's interrupt after this many ticks. `alarm_off()` cancels the
// request.
inline void alarm_in(std::uint64_t ticks) {
  __asm__ volatile("msr cntp_tval_el0, %0\n\tmsr cntp_ctl_el0, %1\n\tisb" ::"r"(ticks),
                   "r"(std::uint64_t{1}));
}
inline void alarm_off() { __asm__ volatile("msr cntp_ctl_el0, xzr\n\tisb" :::); }

// Calls PSCI (ARM DEN 0022) in the platform firmware, which is TF-A or QEMU itself.
inline std::int64_t call_psci(std::uint64_t function, std::uint64_t first = 0,
                              std::uint64_t second = 0, std::uint64_t third = 0) {
  register std::uint64_t x0 __asm__("x0") = function;
  register std::uint64_t x1 __asm__("x1") = first;
  register std::uint64_t x2 __asm__("x2") = second;
  register std::uint64_t x3 __asm__("x3") = third;
  __asm__ volatile("smc #0"
                   : "+r"(x0), "+r"(x1), "+r"(x2), "+r"(x3)
                   :
                   : "x4", "x5", "x6", "x7", "x8", "x9", "x10", "x11", "x12", "x13", "x14", "x15",
                     "x16", "x17", "memory");
  return static_cast<std::int64_t>(x0);
}

}  // namespace iog::machine
