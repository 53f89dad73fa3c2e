// Cadence system watchdog timer, UG1087, module SWDT.
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::zcu102 {

struct WatchdogRegisters {
  Rw32 mode;
  Rw32 control;
  Wo32 restart;
  Ro32 status;

  // A write without the register's key has no effect.
  static constexpr std::uint32_t kModeKey = 0xabcu << 12;
  static constexpr std::uint32_t kModeEnable = 1u << 0;
  static constexpr std::uint32_t kModeReset = 1u << 1;
  static constexpr std::uint32_t kModeReset16Clocks = 3u << 4;
  static constexpr std::uint32_t kControlKey = 0x920000;
  static constexpr unsigned kControlCounterShift = 2;  // the upper twelve of 24 bits
  static constexpr std::uint32_t kControlBy4096 = 3;
  static constexpr std::uint32_t kRestartKey = 0x1999;
};
static_assert(offsetof(WatchdogRegisters, control) == 0x04);
static_assert(offsetof(WatchdogRegisters, restart) == 0x08);

}  // namespace iog::zcu102
