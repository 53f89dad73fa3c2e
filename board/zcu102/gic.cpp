// GIC-400 by ARM IHI 0048, as the Non-secure state sees it: bit 0 enables group 1.
#include "gic.hpp"

#include "gic_lines.hpp"
#include "helper.hpp"
#include "peripherals.hpp"

namespace iog::zcu102 {
void start_gic(GicDistributorRegisters& distributor, GicCpuRegisters& cpu) {
  clear_lines(distributor, cpu);
  let_through(distributor, kInterruptTimer);
  let_through(distributor, kInterruptGem3);
  cpu.pmr.write(GicCpuRegisters::kPmrAll);
  cpu.ctlr.write(GicCpuRegisters::kCtlrEnable);
  distributor.ctlr.write(GicDistributorRegisters::kCtlrEnable);
}

}  // namespace iog::zcu102

namespace iog {

// Software-generated interrupts 0 and 1 are enabled for every core; the CPU interface is its own.
void board::hear_core_0() {
  zcu102::gic_cpu.pmr.write(zcu102::GicCpuRegisters::kPmrAll);
  zcu102::gic_cpu.ctlr.write(zcu102::GicCpuRegisters::kCtlrEnable);
}

}  // namespace iog
