// QEMU's own table of pages, which it looks every access of the guest up in, begins small and grows
// only when it is emptied. Our images never ask for that, so that most of QEMU's time went into
// filling it again. Here it is emptied now and then. The guest cannot see that: no instruction and
// no time of it changes.
#pragma once

#include "qemu_plugin.hpp"

namespace iog::a9_model {

// For each block that QEMU translates.
void watch_supervisor_calls(const qemu_plugin_tb* block);

}  // namespace iog::a9_model
