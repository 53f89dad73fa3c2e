// The PL310 level-2 cache has 1 MiB and lies between the core and DDR. QEMU has no PL310, so calls
// have no effect in QEMU.
#pragma once

#include "registers/pl310.hpp"

namespace iog::imx6 {

class L2Cache {
 public:
  explicit L2Cache(Pl310Registers& registers) : registers_(registers) {}

  // Invalidates the cache and switches it on. Before the call, the cache must be off and contain no
  // dirty lines, as startup.S leaves it. If the controller does not finish the invalidation, the
  // cache stays off, which is slower but correct. Returns true if the cache is on.
  [[nodiscard]] bool start();

  // After this call, all stores of this core are in memory, where a DMA engine reads them.
  //
  // On this chip, a barrier alone is not enough, because the PL310 (r3p1) keeps uncached stores in
  // a store buffer until the buffer is full or a cache sync drains it (ARM erratum 769419).
  void drain_stores();

  // The interface of hal::SharedCache. While content is kept, two of the 16 ways stay open for
  // data. Cached lines are still found in every way, and code may use all ways.
  void keep(bool keep);

 private:
  Pl310Registers& registers_;
};

}  // namespace iog::imx6
