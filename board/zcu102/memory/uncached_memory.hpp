// Memory that is mapped uncached: nothing stands between a store and it but the core's own buffer.
#pragma once

#include "machine.hpp"

namespace iog::zcu102 {

struct UncachedMemory {
  void drain_stores() { machine::barrier(); }
};

}  // namespace iog::zcu102
