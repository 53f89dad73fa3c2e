// Clock Controller Module, i.MX6DQRM chapter "Clock Controller Module (CCM)".
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct CcmRegisters {
  Gap<0x00, 0x24> gap_00;
  Rw32 cscdr1;
  Gap<0x28, 0x54> gap_28;
  Rw32 clpcr;
  Gap<0x58, 0x68> gap_58;
  Rw32 ccgr[7];

  static constexpr std::uint32_t kCscdr1UartPodf = 0x3fu;  // 0: UART clock = PLL3 / 6 = 80 MHz
  static constexpr std::uint32_t kClpcrLpm = 3u << 0;      // 0: WFI stops no clock
  // Each gate has two bits. The value 3 keeps the clock on in every mode.
  static constexpr std::uint32_t kCcgr1Enet = 3u << 10;
  static constexpr std::uint32_t kCcgr1Epit1 = 3u << 12;
  static constexpr std::uint32_t kCcgr1Gpt = 3u << 20;
  static constexpr std::uint32_t kCcgr1GptSerial = 3u << 22;
  static constexpr std::uint32_t kCcgr2Ocotp = 3u << 12;  // iim_clk
  static constexpr std::uint32_t kCcgr2Iomux = 3u << 14;  // iomux_ipt_clk_io
  static constexpr std::uint32_t kCcgr5Uart = 3u << 24;
  static constexpr std::uint32_t kCcgr5UartSerial = 3u << 26;
};

static_assert(offsetof(CcmRegisters, cscdr1) == 0x24);
static_assert(offsetof(CcmRegisters, clpcr) == 0x54);
static_assert(offsetof(CcmRegisters, ccgr) == 0x68);

}  // namespace iog::imx6
