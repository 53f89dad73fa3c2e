// GIC by ARM IHI 0048. The core is in Secure state: what wakes it is in group 1 and comes as an
// interrupt, which is masked; the watchdog's is in group 0 and comes as a fast one.
#include "gic.hpp"

#include "gic_lines.hpp"

namespace iog::imx6 {
namespace {

// More urgent than the other interrupts, which are usually pending and would hide this one.
constexpr std::uint8_t kWatchdogPriority = 0x20;

}  // namespace

void start_gic(GicDistributorRegisters& distributor, GicCpuRegisters& cpu) {
  clear_lines(distributor, cpu);
  for (Rw32& word : distributor.igroupr) {
    word.write(0xffff'ffff);
  }
  distributor.igroupr[kInterruptWatchdog / 32].write(~(1u << kInterruptWatchdog % 32));
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
