// UART, i.MX6DQRM chapter "Universal Asynchronous Receiver/Transmitter". This file contains only
// the bits in use.
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct UartRegisters {
  Gap<0x00, 0x40> gap_00;
  Wo32 utxd;
  Gap<0x44, 0x80> gap_44;
  Rw32 ucr1;
  Rw32 ucr2;
  Rw32 ucr3;
  Rw32 ucr4;
  Rw32 ufcr;
  W1c32 usr1;
  W1c32 usr2;
  Gap<0x9c, 0xa4> gap_9c;
  Rw32 ubir;
  Rw32 ubmr;

  static constexpr std::uint32_t kUcr1UartEn = 1u << 0;
  static constexpr std::uint32_t kUcr1TransmitReadyInterrupt = 1u << 13;  // TRDYEN
  static constexpr std::uint32_t kUcr2NotReset = 1u << 0;                 // SRST, active low
  static constexpr std::uint32_t kUcr2RxEn = 1u << 1;
  static constexpr std::uint32_t kUcr2TxEn = 1u << 2;
  static constexpr std::uint32_t kUcr2EightBits = 1u << 5;   // WS
  static constexpr std::uint32_t kUcr2IgnoreRts = 1u << 14;  // IRTS
  static constexpr std::uint32_t kUcr3RxdMuxSel = 1u << 2;
  static constexpr std::uint32_t kUcr4CtsTrigger32 = 32u << 10;  // CTSTL, its reset value
  static constexpr std::uint32_t kUfcrRxTrigger1 = 1u << 0;      // RXTL
  static constexpr std::uint32_t kUfcrDivideBy1 = 5u << 7;       // RFDIV
  static constexpr std::uint32_t kUfcrTxTrigger2 = 2u << 10;     // TXTL
  static constexpr std::uint32_t kUfcrTxTrigger16 = 16u << 10;   // TXTL
  static constexpr std::uint32_t kUsr1TransmitReady = 1u << 13;  // TRDY
  static constexpr std::uint32_t kUsr2TransmitDone = 1u << 3;    // TXDC
};

static_assert(offsetof(UartRegisters, utxd) == 0x40);
static_assert(offsetof(UartRegisters, ucr1) == 0x80);
static_assert(offsetof(UartRegisters, ucr4) == 0x8c);
static_assert(offsetof(UartRegisters, ufcr) == 0x90);
static_assert(offsetof(UartRegisters, usr2) == 0x98);
static_assert(offsetof(UartRegisters, ubir) == 0xa4);
static_assert(offsetof(UartRegisters, ubmr) == 0xa8);

}  // namespace iog::imx6
