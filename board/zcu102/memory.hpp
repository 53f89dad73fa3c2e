// The firmware's memory: the map that linker/zcu102.ld defines, and its start.
#pragma once

#include "memory/mmu.hpp"

namespace iog::zcu102 {

// The MMU's translation tables; read-only once they are active.
const mmu::Tables& translation_tables();

// True if the address is in a guard: among the stacks, but in none of them.
bool in_stack_guard(std::uint64_t address);

// startup.S calls it once before it zeroes static data and starts the MMU.
extern "C" void start_memory();

}  // namespace iog::zcu102
