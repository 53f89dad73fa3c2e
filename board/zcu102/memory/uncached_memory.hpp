// Memory that is mapped uncached. Stores to this memory pass only through the core's own store
// buffer.
#pragma once

#include "machine.hpp"

namespace iog::zcu102 {

struct UncachedMemory {
  void drain_stores() { machine::barrier(); }
};

}  // namespace iog::zcu102
