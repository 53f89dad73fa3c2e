// The firmware's memory: the map that linker/imx6.ld defines, and the start of MMU and caches.
#pragma once

#include "memory/mmu.hpp"

namespace iog::imx6 {

// The map of this image, with addresses from the linker.
const mmu::MemoryMap& memory_map();

// The MMU's translation tables; read-only after start-up.
const mmu::Tables& translation_tables();

// Whether the L2 cache is on. QEMU has none.
bool l2_cache_is_on();

// Called once by startup.S, before static data is zeroed and before main(). Switches on MMU, L1, L2
// and branch prediction, which are all off before. Starts the watchdog first, so that no later step
// can hang forever.
extern "C" void start_memory();

}  // namespace iog::imx6
