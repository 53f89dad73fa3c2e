// CCM by IMX6DQRM, chapter "Clock Controller Module (CCM)". The PLLs stay as the boot ROM and the
// loader left them: PLL2 at 528 MHz feeds the buses (ipg_clk 66 MHz), PLL3 at 480 MHz the UART.
//
// The 125 MHz of RGMII do not come from the chip's Ethernet PLL on this board: the PHY makes them
// and drives the pad ENET_REF_CLK (pins.cpp), so that PLL is left alone.
#include "clocks.hpp"

namespace iog::imx6 {

void start_clocks(CcmRegisters& ccm) {
  using R = CcmRegisters;
  ccm.ccgr[1].set_bits(R::kCcgr1Enet | R::kCcgr1Epit1 | R::kCcgr1Gpt | R::kCcgr1GptSerial);
  ccm.ccgr[2].set_bits(R::kCcgr2Iomux | R::kCcgr2Ocotp);
  ccm.ccgr[5].set_bits(R::kCcgr5Uart | R::kCcgr5UartSerial);
  ccm.cscdr1.clear_bits(R::kCscdr1UartPodf);
  // LPM resets to WAIT: a WFI would stop the buses too, and by erratum ERR006687 the Ethernet
  // controller cannot end that state. In RUN mode WFI stops the core alone, and any pending
  // interrupt ends it.
  ccm.clpcr.clear_bits(R::kClpcrLpm);
}

}  // namespace iog::imx6
