// Defines the firmware's memory map, according to linker/imx6.ld, and starts the MMU and the
// caches.
#pragma once

#include "memory/mmu.hpp"

namespace iog::imx6 {

// Returns the map of this image, with addresses from the linker.
const mmu::MemoryMap& memory_map();

// Returns the MMU's translation tables, which are read-only after start-up.
const mmu::Tables& translation_tables();

// Returns true if the L2 cache is on. QEMU has no L2 cache.
bool l2_cache_is_on();

// Switches on MMU, L1, L2 and branch prediction, which are all off before. The function starts the
// watchdog first, so that no later step can hang forever. `startup.S` calls this function once,
// before static data is zeroed and before main().
extern "C" void start_memory();

}  // namespace iog::imx6
