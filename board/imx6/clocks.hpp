// Switches on the clocks that this firmware needs.
#pragma once

#include "registers/ccm.hpp"

namespace iog::imx6 {

// Opens the clock gates of UART, GPT, EPIT1, ENET and IOMUXC, sets the UART clock to 80 MHz, and
// makes WFI stop only the core.
void start_clocks(CcmRegisters& ccm);

}  // namespace iog::imx6
