// The PL310 level-2 cache: 1 MiB between the core and DDR. Under QEMU it does not exist; every call
// then does nothing and returns.
#pragma once

#include "registers/pl310.hpp"

namespace iog::imx6 {

class L2Cache {
 public:
  explicit L2Cache(Pl310Registers& registers) : registers_(registers) {}

  // Empty and on. The cache must be off and hold nothing dirty, as startup.S leaves it. A
  // controller that does not finish invalidating stays off: slower, never wrong. Returns whether it
  // is on.
  [[nodiscard]] bool start();

  // Everything this core has stored has reached memory where a DMA engine reads it.
  //
  // A barrier alone is not enough on this chip: its PL310 (r3p1) keeps uncached stores in a store
  // buffer that only drains under pressure (ARM erratum 769419), until a cache sync asks it to.
  void drain_stores();

  // As hal::SharedCache: two of the 16 ways stay open for data. Lines that are in the cache are
  // still found in every way, and code may use all ways.
  void keep(bool keep);

 private:
  Pl310Registers& registers_;
};

}  // namespace iog::imx6
