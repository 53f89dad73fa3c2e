// PL310 by ARM DDI 0246, section 3.1 "Initialization sequence"; settings for the i.MX6Q's
// r3p1-50rel0.
#include "memory/l2_cache.hpp"

namespace iog::imx6 {
namespace {

using R = Pl310Registers;

// Invalidating 32768 lines takes below a millisecond, a sync some hundred nanoseconds; reads of
// this block take at least 20 ns. Both bounds are wide by an order of magnitude.
constexpr unsigned kMaxInvalidatePolls = 1'000'000;
constexpr unsigned kMaxSyncPolls = 10'000;

}  // namespace

bool L2Cache::start() {
  // Latencies and auxiliary control may only change while the cache is off.
  registers_.control.write(0);
  // One cycle set-up, three read, two write... as field values minus one: what Freescale states for
  // the RAMs of this chip at every core frequency.
  registers_.tag_ram_control.write(R::kLatency132);
  registers_.data_ram_control.write(R::kLatency132);
  // Bit 22: without it the PL310 treats shared uncached accesses as cacheable without allocation,
  // and the DMA region would be read from lines that a speculative access once brought in.
  // The cores' ACTLR has neither lines of zeros in one write nor exclusive caches: both sides or
  // none.
  const std::uint32_t left = registers_.aux_control.read();
  registers_.aux_control.write((left & ~(R::kAuxFullLineOfZeros | R::kAuxExclusive)) |
                               R::kAuxSharedOverride);
  // Prefetch for code and data. Double linefill off: erratum 752271 of r3p1 corrupts data with it.
  registers_.prefetch_control.clear_bits(R::kPrefetchDoubleLinefill);
  registers_.prefetch_control.set_bits(R::kPrefetchData | R::kPrefetchInstruction);
  registers_.power_control.set_bits(R::kPowerDynamicClockGating);
  registers_.interrupt_mask.write(0);
  // A loader may have locked ways.
  keep(false);
  for (Pl310Lockdown& lockdown : registers_.lockdown) {
    lockdown.instruction.write(0);
  }

  registers_.invalidate_by_way.write(R::kAllWays);
  unsigned polls = 0;
  while ((registers_.invalidate_by_way.read() & R::kAllWays) != 0) {
    if (++polls == kMaxInvalidatePolls) {
      return false;
    }
  }
  drain_stores();
  registers_.control.write(R::kControlEnable);
  machine::barrier();
  return (registers_.control.read() & R::kControlEnable) != 0;
}

// ARM DDI 0246, 2.3.4 "Cache lockdown": a locked way is still searched, and stores still hit in it.
void L2Cache::keep(bool keep) {
  for (Pl310Lockdown& lockdown : registers_.lockdown) {
    lockdown.data.write(keep ? R::kAllWays & ~R::kOpenWays : 0);
  }
}

void L2Cache::drain_stores() {
  machine::barrier();
  registers_.cache_sync.write(0);
  for (unsigned polls = 0; polls < kMaxSyncPolls; ++polls) {
    if ((registers_.cache_sync.read() & 1) == 0) {
      break;
    }
  }
  machine::barrier();
}

}  // namespace iog::imx6
