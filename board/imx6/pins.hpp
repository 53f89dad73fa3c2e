// The pads of the SABRE Lite that this firmware uses, and the hardware reset of its PHY.
#pragma once

#include "registers/iomuxc.hpp"
#include "time/gpt_clock.hpp"

namespace iog::imx6 {

// Pads EIM_D26 and EIM_D27 become UART2.
void start_console_pins(IomuxcRegisters& iomuxc);

// Pads SD3_DAT7 and SD3_DAT6 become UART1, the serial link of the grid.
void start_serial_pins(IomuxcRegisters& iomuxc);

// Resets the KSZ9021 while driving its strapping pins, and then connects MDIO and RGMII. The reset
// takes 10.1 ms.
void start_ethernet_pins(IomuxcRegisters& iomuxc, GpioRegisters& gpio3, GpioRegisters& gpio6,
                         GptClock& clock);

}  // namespace iog::imx6
