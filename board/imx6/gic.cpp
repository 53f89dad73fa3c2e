// GIC by ARM IHI 0048. The core is in Secure state: what wakes it is in group 1 and comes as an
// interrupt, which is masked; the watchdog's is in group 0 and comes as a fast one.
#include "gic.hpp"

namespace iog::imx6 {
namespace {

// Anything above the mask of 0xff in urgency; and the watchdog's above the others', which are
// mostly pending and would be all that a core is told.
constexpr std::uint8_t kPriority = 0xa0;
constexpr std::uint8_t kWatchdogPriority = 0x20;
constexpr std::uint8_t kCore0 = 1u << 0;

void let_through(GicDistributorRegisters& distributor, unsigned interrupt,
                 std::uint8_t priority = kPriority) {
  distributor.ipriorityr[interrupt].write(priority);
  distributor.itargetsr[interrupt].write(kCore0);
  distributor.isenabler[interrupt / 32].write(1u << (interrupt % 32));
}

}  // namespace

void start_gic(GicDistributorRegisters& distributor, GicCpuRegisters& cpu) {
  distributor.ctlr.write(0);
  cpu.ctlr.write(0);
  // A loader may have left lines enabled and edges pending.
  for (Rw32& word : distributor.icenabler) {
    word.write(0xffff'ffff);
  }
  for (Rw32& word : distributor.icpendr) {
    word.write(0xffff'ffff);
  }
  for (Rw32& word : distributor.igroupr) {
    word.write(0xffff'ffff);
  }
  distributor.igroupr[kInterruptWatchdog / 32].write(~(1u << kInterruptWatchdog % 32));
  // Level-sensitive: the reset state, written because of the loader.
  for (unsigned word = 2; word < GicDistributorRegisters::kInterrupts / 16; ++word) {
    distributor.icfgr[word].write(0);  // words 0 and 1 are the private interrupts, fixed
  }
  let_through(distributor, kInterruptUart1);
  let_through(distributor, kInterruptEpit1);
  let_through(distributor, kInterruptEnet);
  let_through(distributor, kInterruptWatchdog, kWatchdogPriority);
  cpu.pmr.write(GicCpuRegisters::kPmrAll);
  cpu.ctlr.write(GicCpuRegisters::kCtlrEnable | GicCpuRegisters::kCtlrEnableGroup1 |
                 GicCpuRegisters::kCtlrFiq);
  distributor.ctlr.write(GicDistributorRegisters::kCtlrEnable |
                         GicDistributorRegisters::kCtlrEnableGroup1);
}

}  // namespace iog::imx6
