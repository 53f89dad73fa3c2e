// The peripherals of this chip. `linker/imx6_peripherals.ld` gives each symbol its address and its
// chapter.
#pragma once

#include "registers/analog.hpp"
#include "registers/ccm.hpp"
#include "registers/enet.hpp"
#include "registers/epit.hpp"
#include "registers/gic.hpp"
#include "registers/gpt.hpp"
#include "registers/iomuxc.hpp"
#include "registers/mpcore.hpp"
#include "registers/ocotp.hpp"
#include "registers/pl310.hpp"
#include "registers/src.hpp"
#include "registers/uart.hpp"
#include "registers/watchdog.hpp"

namespace iog::imx6 {

// These symbols are never defined, so they are never initialised. Clang-tidy cannot detect this.
// NOLINTBEGIN(bugprone-dynamic-static-initializers)
extern "C" {
extern ScuRegisters scu;
extern GicCpuRegisters gic_cpu;
extern GlobalTimerRegisters global_timer;
extern GicDistributorRegisters gic_distributor;
extern Pl310Registers pl310;
extern GptRegisters gpt;
extern GpioRegisters gpio3;
extern GpioRegisters gpio6;
extern WatchdogRegisters wdog1;
extern CcmRegisters ccm;
extern AnalogRegisters analog;
extern EpitRegisters epit1;
extern SrcRegisters src;
extern IomuxcRegisters iomuxc;
extern EnetRegisters enet;
extern OcotpRegisters ocotp;
extern UartRegisters uart1;
extern UartRegisters uart2;
}
// NOLINTEND(bugprone-dynamic-static-initializers)

}  // namespace iog::imx6
