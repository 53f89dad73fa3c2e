// System Reset Controller, i.MX6DQRM chapter "System Reset Controller (SRC)".
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct SrcRegisters {
  // The entry address and argument that the boot ROM passes to a core after its reset.
  struct Entry {
    Rw32 address;   // PERSISTENT_ENTRYn: SRC_GPR1, 3, 5, 7
    Rw32 argument;  // PERSISTENT_ARGn: SRC_GPR2, 4, 6, 8
  };

  Rw32 scr;
  Ro32 sbmr1;
  Ro32 srsr;
  Gap<0x0c, 0x20> gap_0c;
  Entry entry[4];  // one per core

  static constexpr std::uint32_t kSrsrPowerOn = 1u << 0;       // ipp_reset_b
  static constexpr std::uint32_t kSrsrWatchdog = 1u << 4;      // wdog_rst_b
  static constexpr unsigned kScrCore1ResetShift = 14;          // core2_rst is 15, core3_rst 16
  static constexpr std::uint32_t kScrCoreResets = 0xfu << 13;  // all four; they clear themselves
  static constexpr unsigned kScrCore1EnableShift = 22;  // core2_enable is 23, core3_enable 24
};

static_assert(offsetof(SrcRegisters, srsr) == 0x08);
static_assert(offsetof(SrcRegisters, entry) == 0x20);
static_assert(sizeof(SrcRegisters) == 0x40);

}  // namespace iog::imx6
