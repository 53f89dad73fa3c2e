// General Purpose Timer, i.MX6DQRM chapter "General Purpose Timer (GPT)".
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct GptRegisters {
  Rw32 cr;
  Rw32 pr;
  W1c32 sr;
  Rw32 ir;
  Gap<0x10, 0x24> gap_10;
  Ro32 cnt;

  static constexpr std::uint32_t kCrEnable = 1u << 0;
  static constexpr std::uint32_t kCrResetOnEnable = 1u << 1;  // ENMOD
  static constexpr std::uint32_t kCrRunInWait = 1u << 3;      // WAITEN
  static constexpr std::uint32_t kCrPeripheral = 1u << 6;     // CLKSRC: ipg_clk, 66 MHz
  static constexpr std::uint32_t kCrCrystalBy8 = 5u << 6;     // CLKSRC: 24 MHz / 8 = 3 MHz
  static constexpr std::uint32_t kCrFreeRun = 1u << 9;        // FRR
  static constexpr std::uint32_t kCrSoftReset = 1u << 15;     // SWR, clears itself
  static constexpr std::uint32_t kSrAll = 0x3f;
};

static_assert(offsetof(GptRegisters, ir) == 0x0c);
static_assert(offsetof(GptRegisters, cnt) == 0x24);

}  // namespace iog::imx6
