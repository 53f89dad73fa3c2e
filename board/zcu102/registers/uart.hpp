// Cadence UART, UG1087, module UART.
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::zcu102 {

struct UartRegisters {
  Rw32 control;
  Rw32 mode;
  Gap<0x08, 0x0c> gap_08;
  Wo32 interrupt_disable;
  Gap<0x10, 0x18> gap_10;
  Rw32 baud_generator;
  Gap<0x1c, 0x2c> gap_1c;
  Ro32 channel_status;
  Rw32 fifo;
  Rw32 baud_divider;

  static constexpr std::uint32_t kControlResetTransmitter = 1u << 1;
  static constexpr std::uint32_t kControlResetReceiver = 1u << 0;
  static constexpr std::uint32_t kControlTransmit = 1u << 4;
  static constexpr std::uint32_t kControlTransmitOff = 1u << 5;
  static constexpr std::uint32_t kControlReceive = 1u << 2;
  static constexpr std::uint32_t kModeEightBitsNoParity = 0x20;
  static constexpr std::uint32_t kStatusTransmitFull = 1u << 4;
  static constexpr std::uint32_t kStatusTransmitEmpty = 1u << 3;
  static constexpr std::uint32_t kStatusTransmitting = 1u << 11;
};
static_assert(offsetof(UartRegisters, interrupt_disable) == 0x0c);
static_assert(offsetof(UartRegisters, baud_generator) == 0x18);
static_assert(offsetof(UartRegisters, channel_status) == 0x2c);
static_assert(offsetof(UartRegisters, baud_divider) == 0x34);

}  // namespace iog::zcu102
