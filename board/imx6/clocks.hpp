// The clocks this firmware needs, switched on by name.
#pragma once

#include "registers/ccm.hpp"

namespace iog::imx6 {

// Opens the gates of UART, GPT, EPIT1, ENET and IOMUXC, sets the UART clock to 80 MHz, and lets WFI
// stop nothing but the core.
void start_clocks(CcmRegisters& ccm);

}  // namespace iog::imx6
