// The parts that machine.hpp has on every board: single loads and stores of device registers and
// DMA descriptors, the barrier, and sleep. The instructions have the same names in A32 and A64.
#pragma once

#include <cstdint>

namespace iog::machine {

// One access of exactly the width of T, never merged, split or dropped by the compiler.
template <typename T>
inline T load(const T& location) {
  return *static_cast<const volatile T*>(&location);
}

template <typename T>
inline void store(T& location, T value) {
  *static_cast<volatile T*>(&location) = value;
}

// Makes all earlier stores of this core visible to every DMA engine before any later access. It is
// a DSB and not a DMB, because the next store usually goes to a device register that starts the
// engine.
inline void barrier() { __asm__ volatile("dsb sy" ::: "memory"); }

// Sleeps until an interrupt is pending at the GIC's CPU interface, masked or not.
inline void wait_for_interrupt() { __asm__ volatile("dsb sy\n\twfi" ::: "memory"); }

// Hints that this core waits for another core. QEMU then runs another core; hardware does nothing.
inline void yield() { __asm__ volatile("yield" ::: "memory"); }

// The address on the bus. Memory is identity-mapped and lies below 4 GiB.
template <typename T>
inline std::uint32_t bus_address(const T& object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&object));
}

}  // namespace iog::machine
