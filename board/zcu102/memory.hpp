// Defines the firmware's memory map, according to linker/zcu102.ld, and starts the memory.
#pragma once

#include "memory/mmu.hpp"

namespace iog::zcu102 {

// Returns the MMU's translation tables, which are read-only as soon as they are active.
const mmu::Tables& translation_tables();

// Returns true if the address is in a guard, that is, among the stacks, but in no stack.
bool in_stack_guard(std::uint64_t address);

// startup.S calls this function once, before it zeroes static data and starts the MMU.
extern "C" void start_memory();

}  // namespace iog::zcu102
