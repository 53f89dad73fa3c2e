// The private peripherals of the Cortex-A9 MPCore, ARM DDI 0407 (MPCore TRM): snoop control unit
// and global timer.
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct ScuRegisters {
  Rw32 control;
  Ro32 configuration;
  Rw32 power;
  Wo32 invalidate_all;

  static constexpr std::uint32_t kControlEnable = 1u << 0;
  static constexpr std::uint32_t kConfigurationCores = 0x3;  // number of cores minus 1
  static constexpr std::uint32_t kInvalidateAllWaysAllCores = 0xffff;
};

static_assert(offsetof(ScuRegisters, invalidate_all) == 0x0c);

struct GlobalTimerRegisters {
  Rw32 counter_low;
  Rw32 counter_high;
  Rw32 control;

  static constexpr std::uint32_t kControlEnable = 1u << 0;
};

static_assert(offsetof(GlobalTimerRegisters, control) == 0x08);

}  // namespace iog::imx6
