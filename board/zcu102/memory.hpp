// Memory as the running firmware sees it: the map that linker/zcu102.ld laid out, and its start.
#pragma once

#include "memory/mmu.hpp"

namespace iog::zcu102 {

// What the MMU walks; read-only once it is in force.
const mmu::Tables& translation_tables();

// Is this the address of a guard: among the stacks, but of none of them?
bool in_stack_guard(std::uint64_t address);

// Called once by startup.S, before static data is zeroed; then it starts the MMU.
extern "C" void start_memory();

}  // namespace iog::zcu102
