// PL310 level-2 cache controller, ARM DDI 0246 (L2C-310 TRM). QEMU has no PL310, so reads return 0,
// and writes have no effect.
#pragma once

#include <array>
#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

// Lockdown by way (section 3.3.9): a set bit prevents allocation in its way.
struct Pl310Lockdown {
  Rw32 data;
  Rw32 instruction;
};

struct Pl310Registers {
  Ro32 cache_id;
  Ro32 cache_type;
  Gap<0x008, 0x100> gap_008;
  Rw32 control;
  Rw32 aux_control;
  Rw32 tag_ram_control;
  Rw32 data_ram_control;
  Gap<0x110, 0x214> gap_110;
  Rw32 interrupt_mask;
  Gap<0x218, 0x730> gap_218;
  Rw32 cache_sync;
  Gap<0x734, 0x77c> gap_734;
  Rw32 invalidate_by_way;
  Gap<0x780, 0x7fc> gap_780;
  Rw32 clean_invalidate_by_way;
  Gap<0x800, 0x900> gap_800;
  std::array<Pl310Lockdown, 8> lockdown;  // by master, if the option exists; otherwise 0
  Gap<0x940, 0xf60> gap_940;
  Rw32 prefetch_control;
  Gap<0xf64, 0xf80> gap_f64;
  Rw32 power_control;

  static constexpr std::uint32_t kControlEnable = 1u << 0;
  static constexpr std::uint32_t kAllWays = 0xffff;   // 16 ways of 64 KiB
  static constexpr std::uint32_t kOpenWays = 0xc000;  // stay open while the others are locked
  static constexpr std::uint32_t kAuxFullLineOfZeros = 1u << 0;
  static constexpr std::uint32_t kAuxExclusive = 1u << 12;
  static constexpr std::uint32_t kAuxSharedOverride = 1u << 22;
  static constexpr std::uint32_t kLatency132 = 0x132;
  static constexpr std::uint32_t kPrefetchData = 1u << 28;
  static constexpr std::uint32_t kPrefetchInstruction = 1u << 29;
  static constexpr std::uint32_t kPrefetchDoubleLinefill = 1u << 30;
  static constexpr std::uint32_t kPowerDynamicClockGating = 1u << 1;
};

static_assert(offsetof(Pl310Registers, control) == 0x100);
static_assert(offsetof(Pl310Registers, data_ram_control) == 0x10c);
static_assert(offsetof(Pl310Registers, interrupt_mask) == 0x214);
static_assert(offsetof(Pl310Registers, cache_sync) == 0x730);
static_assert(offsetof(Pl310Registers, invalidate_by_way) == 0x77c);
static_assert(offsetof(Pl310Registers, clean_invalidate_by_way) == 0x7fc);
static_assert(offsetof(Pl310Registers, lockdown) == 0x900);
static_assert(offsetof(Pl310Registers, prefetch_control) == 0xf60);
static_assert(offsetof(Pl310Registers, power_control) == 0xf80);

}  // namespace iog::imx6
