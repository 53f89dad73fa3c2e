// Generic Interrupt Controller of the Cortex-A9 MPCore, ARM IHI 0048 (GIC architecture), version 1.
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct GicDistributorRegisters {
  static constexpr unsigned kInterrupts = 160;  // 32 private and 128 shared on the i.MX6Q

  Rw32 ctlr;
  Ro32 typer;
  Gap<0x08, 0x80> gap_08;
  Rw32 igroupr[kInterrupts / 32];
  Gap<0x94, 0x100> gap_94;
  Rw32 isenabler[kInterrupts / 32];  // writing a one enables, zeros do nothing
  Gap<0x114, 0x180> gap_114;
  Rw32 icenabler[kInterrupts / 32];  // writing a one disables, zeros do nothing
  Gap<0x194, 0x280> gap_194;
  Rw32 icpendr[kInterrupts / 32];
  Gap<0x294, 0x400> gap_294;
  Rw<std::uint8_t> ipriorityr[kInterrupts];
  Gap<0x4a0, 0x800> gap_4a0;
  Rw<std::uint8_t> itargetsr[kInterrupts];
  Gap<0x8a0, 0xc00> gap_8a0;
  Rw32 icfgr[kInterrupts / 16];
  Gap<0xc28, 0xf00> gap_c28;
  Wo32 sgir;

  static constexpr std::uint32_t kCtlrEnable = 1u << 0;  // group 0
  static constexpr std::uint32_t kCtlrEnableGroup1 = 1u << 1;
  static constexpr unsigned kSgirTargetShift = 16;  // CPUTargetList, one bit a core
};

static_assert(offsetof(GicDistributorRegisters, igroupr) == 0x080);
static_assert(offsetof(GicDistributorRegisters, isenabler) == 0x100);
static_assert(offsetof(GicDistributorRegisters, icenabler) == 0x180);
static_assert(offsetof(GicDistributorRegisters, icpendr) == 0x280);
static_assert(offsetof(GicDistributorRegisters, ipriorityr) == 0x400);
static_assert(offsetof(GicDistributorRegisters, itargetsr) == 0x800);
static_assert(offsetof(GicDistributorRegisters, icfgr) == 0xc00);
static_assert(offsetof(GicDistributorRegisters, sgir) == 0xf00);

struct GicCpuRegisters {
  Rw32 ctlr;
  Rw32 pmr;
  Rw32 bpr;
  Ro32 iar;
  Wo32 eoir;

  static constexpr std::uint32_t kCtlrEnable = 1u << 0;  // group 0
  static constexpr std::uint32_t kCtlrEnableGroup1 = 1u << 1;
  static constexpr std::uint32_t kCtlrFiq = 1u << 3;  // group 0 comes as fast interrupts
  static constexpr std::uint32_t kPmrAll = 0xff;
};

static_assert(offsetof(GicCpuRegisters, pmr) == 0x04);
static_assert(offsetof(GicCpuRegisters, iar) == 0x0c);
static_assert(offsetof(GicCpuRegisters, eoir) == 0x10);

}  // namespace iog::imx6
