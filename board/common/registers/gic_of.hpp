// The Generic Interrupt Controller, ARM IHI 0048 (GIC architecture). This file contains the
// registers that version 1 (Cortex-A9 MPCore) and version 2 (GIC-400) have in common. The number of
// interrupts is a parameter.
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::board {

template <unsigned kCount>
struct GicDistributorOf {
  static constexpr unsigned kInterrupts = kCount;

  Rw32 ctlr;
  Ro32 typer;
  Gap<0x08, 0x80> gap_08;
  Rw32 igroupr[kInterrupts / 32];
  Gap<0x80 + kInterrupts / 8, 0x100> behind_igroupr;
  Rw32 isenabler[kInterrupts / 32];  // writing a one enables, zeros do nothing
  Gap<0x100 + kInterrupts / 8, 0x180> behind_isenabler;
  Rw32 icenabler[kInterrupts / 32];  // writing a one disables, zeros do nothing
  Gap<0x180 + kInterrupts / 8, 0x280> behind_icenabler;
  Rw32 icpendr[kInterrupts / 32];
  Gap<0x280 + kInterrupts / 8, 0x400> behind_icpendr;
  Rw<std::uint8_t> ipriorityr[kInterrupts];
  Gap<0x400 + kInterrupts, 0x800> behind_ipriorityr;
  Rw<std::uint8_t> itargetsr[kInterrupts];
  Gap<0x800 + kInterrupts, 0xc00> behind_itargetsr;
  Rw32 icfgr[kInterrupts / 16];
  Gap<0xc00 + kInterrupts / 4, 0xf00> behind_icfgr;
  Wo32 sgir;

  static constexpr std::uint32_t kCtlrEnable = 1u << 0;  // group 0
  static constexpr std::uint32_t kCtlrEnableGroup1 = 1u << 1;
  static constexpr unsigned kSgirTargetShift = 16;  // CPUTargetList, one bit per core
};

// Checks the offsets against the manual.
template <typename D>
inline constexpr bool kIsLaidOut = offsetof(D, igroupr) == 0x080 &&
                                   offsetof(D, isenabler) == 0x100 &&
                                   offsetof(D, icenabler) == 0x180 &&
                                   offsetof(D, icpendr) == 0x280 &&
                                   offsetof(D, ipriorityr) == 0x400 &&
                                   offsetof(D, itargetsr) == 0x800 && offsetof(D, icfgr) == 0xc00 &&
                                   offsetof(D, sgir) == 0xf00;

struct GicCpuRegisters {
  Rw32 ctlr;
  Rw32 pmr;
  Rw32 bpr;
  Ro32 iar;
  Wo32 eoir;

  static constexpr std::uint32_t kCtlrEnable = 1u << 0;  // group 0
  static constexpr std::uint32_t kCtlrEnableGroup1 = 1u << 1;
  static constexpr std::uint32_t kCtlrFiq = 1u << 3;  // group 0 raises fast interrupts
  static constexpr std::uint32_t kPmrAll = 0xff;
};

static_assert(offsetof(GicCpuRegisters, pmr) == 0x04);
static_assert(offsetof(GicCpuRegisters, iar) == 0x0c);
static_assert(offsetof(GicCpuRegisters, eoir) == 0x10);

}  // namespace iog::board
