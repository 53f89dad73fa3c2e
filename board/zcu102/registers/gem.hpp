// Cadence Gigabit Ethernet MAC, UG1087, module GEM.
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::zcu102 {

struct GemRegisters {
  Rw32 nwctrl;
  Rw32 nwcfg;
  Ro32 nwstatus;
  Gap<0x0c, 0x10> gap_0c;
  Rw32 dmacfg;
  W1c32 txstatus;
  Rw32 rxqbase;
  Rw32 txqbase;
  W1c32 rxstatus;
  Ro32 isr;  // reading clears
  Wo32 ier;
  Wo32 idr;
  Gap<0x30, 0x34> gap_30;
  Rw32 phymntnc;
  Gap<0x38, 0x80> gap_38;
  Rw32 hash[2];
  struct {
    Rw32 low;
    Rw32 high;  // its write puts the address into force
  } address[4];
  Gap<0xa8, 0x440> gap_a8;
  Rw32 txq1base;
  Gap<0x444, 0x480> gap_444;
  Rw32 rxq1base;
  Gap<0x484, 0x4c8> gap_484;
  Rw32 txqbase_high;
  Gap<0x4cc, 0x4d4> gap_4cc;
  Rw32 rxqbase_high;

  static constexpr std::uint32_t kNwctrlReceive = 1u << 2;
  static constexpr std::uint32_t kNwctrlTransmit = 1u << 3;
  static constexpr std::uint32_t kNwctrlMdio = 1u << 4;
  static constexpr std::uint32_t kNwctrlClearStatistics = 1u << 5;
  static constexpr std::uint32_t kNwctrlStartTransmit = 1u << 9;
  static constexpr std::uint32_t kNwcfgFullDuplex = 1u << 1;
  static constexpr std::uint32_t kNwcfgMulticastHash = 1u << 6;
  static constexpr std::uint32_t kNwcfgGigabit = 1u << 10;
  static constexpr std::uint32_t kNwcfgRemoveFcs = 1u << 17;
  static constexpr std::uint32_t kNwcfgMdcBy224 = 7u << 18;
  static constexpr std::uint32_t kNwcfg64BitBus = 1u << 21;
  static constexpr std::uint32_t kNwcfgReceiveChecksum = 1u << 24;
  static constexpr std::uint32_t kDmacfg64BitAddresses = 1u << 30;
  static constexpr std::uint32_t kDmacfgWholeMemories = 1u << 10 | 3u << 8;
  static constexpr std::uint32_t kDmacfgBurst16 = 0x10;
  static constexpr std::uint32_t kRxstatusNoBuffer = 1u << 0;
  static constexpr std::uint32_t kRxstatusReceived = 1u << 1;
  static constexpr std::uint32_t kIerReceived = 1u << 1;
};
static_assert(offsetof(GemRegisters, dmacfg) == 0x10);
static_assert(offsetof(GemRegisters, rxqbase) == 0x18);
static_assert(offsetof(GemRegisters, isr) == 0x24);
static_assert(offsetof(GemRegisters, phymntnc) == 0x34);
static_assert(offsetof(GemRegisters, address) == 0x88);
static_assert(offsetof(GemRegisters, rxq1base) == 0x480);
static_assert(offsetof(GemRegisters, rxqbase_high) == 0x4d4);

}  // namespace iog::zcu102
