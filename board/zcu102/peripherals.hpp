// The peripherals of this chip. `linker/zcu102_peripherals.ld` gives each symbol its address.
#pragma once

#include "registers/gem.hpp"
#include "registers/gic.hpp"
#include "registers/uart.hpp"
#include "registers/watchdog.hpp"

namespace iog::zcu102 {

// These symbols are never defined, so they are never initialised. Clang-tidy cannot detect this.
// NOLINTBEGIN(bugprone-dynamic-static-initializers)
extern "C" {
extern board::GicCpuRegisters gic_cpu;
extern GicDistributorRegisters gic_distributor;
extern WatchdogRegisters swdt;
extern UartRegisters uart0;
extern UartRegisters uart1;
extern CrlApbRegisters crl_apb;
extern GemRegisters gem3;
}
// NOLINTEND(bugprone-dynamic-static-initializers)

}  // namespace iog::zcu102
