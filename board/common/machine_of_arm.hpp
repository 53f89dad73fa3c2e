// Contains the parts of machine.hpp that all boards share: single loads and stores of device
// registers and DMA descriptors, the barrier, and sleep. The instructions have the same names in
// A32 and A64.
#pragma once

#include <cstdint>

namespace iog::machine {

// Each function performs one access of exactly the width of T, which the compiler never merges,
// splits or drops.
template <typename T>
inline T load(const T& location) {
  return *static_cast<const volatile T*>(&location);
}

template <typename T>
inline void store(T& location, T value) {
  *static_cast<volatile T*>(&location) = value;
}

// Makes all earlier stores of this core visible to every DMA engine before any later access. The
// barrier is a DSB and not a DMB, because the next store usually goes to a device register that
// starts the engine.
inline void barrier() { __asm__ volatile("dsb sy" ::: "memory"); }

// Sleeps until an interrupt is pending at the GIC's CPU interface, masked or not.
inline void wait_for_interrupt() { __asm__ volatile("dsb sy\n\twfi" ::: "memory"); }

// Hints that this core waits for another core. In QEMU, another core then runs. On hardware, the
// hint has no effect.
inline void yield() { __asm__ volatile("yield" ::: "memory"); }

// Returns the address on the bus. Memory is identity-mapped and lies below 4 GiB.
template <typename T>
inline std::uint32_t bus_address(const T& object) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(&object));
}

}  // namespace iog::machine
