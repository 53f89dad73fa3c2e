// Watchdog Timer, i.MX6DQRM chapter "Watchdog Timer (WDOG1-2)". All registers have 16 bits.
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct WatchdogRegisters {
  Rw16 wcr;
  Rw16 wsr;
  Ro16 wrsr;
  Rw16 wicr;
  Rw16 wmcr;

  static constexpr std::uint16_t kWcrEnable = 1u << 2;            // WDE, write once
  static constexpr std::uint16_t kWcrNoSoftwareReset = 1u << 4;   // SRS, active low
  static constexpr std::uint16_t kWcrNoExternalAssert = 1u << 5;  // WDA, active low
  static constexpr unsigned kWcrTimeoutShift = 8;                 // WT: (WT + 1) half seconds
  static constexpr std::uint16_t kWicrEnable = 1u << 15;          // WIE, write once
  static constexpr std::uint16_t kWsrFirst = 0x5555;
  static constexpr std::uint16_t kWsrSecond = 0xaaaa;
};

static_assert(offsetof(WatchdogRegisters, wrsr) == 0x04);
static_assert(offsetof(WatchdogRegisters, wicr) == 0x06);
static_assert(offsetof(WatchdogRegisters, wmcr) == 0x08);

}  // namespace iog::imx6
