// The analog block, i.MX6DQRM chapters "Power Management Unit (PMU)" (MISC0), "Temperature Monitor
// (TEMPMON)" (TEMPSENSE0 and 1) and "Universal Serial Bus 2.0 Integrated PHY (USB-PHY)" (DIGPROG).
// The additional registers that set, clear and toggle bits are not used.
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct AnalogRegisters {
  Gap<0x000, 0x150> gap_000;
  Rw32 misc0;
  Gap<0x154, 0x180> gap_154;
  Rw32 tempsense0;
  Gap<0x184, 0x190> gap_184;
  Rw32 tempsense1;
  Gap<0x194, 0x260> gap_194;
  Ro32 digprog;

  static constexpr std::uint32_t kMisc0SelfBiasOff = 1u << 3;  // REFTOP_SELFBIASOFF
  static constexpr std::uint32_t kTempsense0PowerDown = 1u << 0;
  static constexpr std::uint32_t kTempsense0Measure = 1u << 1;
  static constexpr std::uint32_t kTempsense0Finished = 1u << 2;
  static constexpr unsigned kTempsense0CountShift = 8;  // TEMP_CNT
  static constexpr std::uint32_t kTempsense0CountMask = 0xfff;
  static constexpr std::uint32_t kDigprogRevision = 0xffff;  // major and minor; 0 is 1.0
};

static_assert(offsetof(AnalogRegisters, misc0) == 0x150);
static_assert(offsetof(AnalogRegisters, tempsense0) == 0x180);
static_assert(offsetof(AnalogRegisters, tempsense1) == 0x190);
static_assert(offsetof(AnalogRegisters, digprog) == 0x260);

}  // namespace iog::imx6
