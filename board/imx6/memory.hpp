// Memory as the running firmware sees it: the map that linker/imx6.ld laid out, and the start of
// MMU and caches.
#pragma once

#include "memory/mmu.hpp"

namespace iog::imx6 {

// The map of this image, addresses taken from the linker.
const mmu::MemoryMap& memory_map();

// What the MMU walks; read-only after the start.
const mmu::Tables& translation_tables();

// Whether the L2 cache came on. QEMU has none.
bool l2_cache_is_on();

// Called once by startup.S, before static data is zeroed and before main(). All of it is off when
// it is called; when it returns, MMU, L1, L2 and branch prediction are on. The watchdog is started
// first, so that no step from here on can hang for good.
extern "C" void start_memory();

}  // namespace iog::imx6
