#include "helper.hpp"
#include "peripherals.hpp"

namespace iog {

// The registers of the GIC's CPU interface are each core's own, and so is the group of each private
// interrupt. This puts wake and stop into group 0, whatever the loader has left.
void board::hear_core_0() {
  imx6::gic_distributor.igroupr[0].write(0);
  imx6::gic_cpu.pmr.write(imx6::GicCpuRegisters::kPmrAll);
  imx6::gic_cpu.ctlr.write(imx6::GicCpuRegisters::kCtlrEnable);
}

}  // namespace iog
