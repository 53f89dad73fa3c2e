// Enhanced Periodic Interrupt Timer, i.MX6DQRM chapter "Enhanced Periodic Interrupt Timer (EPIT)".
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct EpitRegisters {
  Rw32 cr;
  W1c32 sr;
  Rw32 lr;
  Rw32 cmpr;
  Ro32 cnr;

  static constexpr std::uint32_t kCrEnable = 1u << 0;
  static constexpr std::uint32_t kCrStartFromLoad = 1u << 1;     // ENMOD
  static constexpr std::uint32_t kCrInterrupt = 1u << 2;         // OCIEN
  static constexpr std::uint32_t kCrReload = 1u << 3;            // RLD
  static constexpr std::uint32_t kCrSoftReset = 1u << 16;        // SWR, clears itself
  static constexpr std::uint32_t kCrLoadAtOnce = 1u << 17;       // IOVW
  static constexpr std::uint32_t kCrRunInWait = 1u << 19;        // WAITEN
  static constexpr std::uint32_t kCrPeripheralClock = 1u << 24;  // CLKSRC: ipg_clk, 66 MHz
  static constexpr std::uint32_t kSrCompare = 1u << 0;           // OCIF
};

static_assert(offsetof(EpitRegisters, cmpr) == 0x0c);
static_assert(offsetof(EpitRegisters, cnr) == 0x10);

}  // namespace iog::imx6
