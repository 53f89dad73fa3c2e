// 10/100/1000 Ethernet MAC, i.MX6DQRM chapter "10/100/1000-Mbps Ethernet MAC (ENET)".
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct EnetRegisters {
  Gap<0x000, 0x004> gap_000;
  W1c32 eir;
  Rw32 eimr;
  Gap<0x00c, 0x010> gap_00c;
  Rw32 rdar;
  Rw32 tdar;
  Gap<0x018, 0x024> gap_018;
  Rw32 ecr;
  Gap<0x028, 0x040> gap_028;
  Rw32 mmfr;
  Rw32 mscr;
  Gap<0x048, 0x064> gap_048;
  Rw32 mibc;
  Gap<0x068, 0x084> gap_068;
  Rw32 rcr;
  Gap<0x088, 0x0c4> gap_088;
  Rw32 tcr;
  Gap<0x0c8, 0x0e4> gap_0c8;
  Rw32 palr;
  Rw32 paur;
  Rw32 opd;
  Gap<0x0f0, 0x118> gap_0f0;
  Rw32 iaur;
  Rw32 ialr;
  Rw32 gaur;
  Rw32 galr;
  Gap<0x128, 0x144> gap_128;
  Rw32 tfwr;
  Gap<0x148, 0x180> gap_148;
  Rw32 rdsr;
  Rw32 tdsr;
  Rw32 mrbr;
  Gap<0x18c, 0x1b0> gap_18c;
  Rw32 ftrl;
  Gap<0x1b4, 0x1c0> gap_1b4;
  Rw32 tacc;
  Rw32 racc;
  Gap<0x1c8, 0x2d8> gap_1c8;
  Rw32 ieee_r_macerr;  // frames that did not fit in the receive FIFO

  static constexpr std::uint32_t kEirBusError = 1u << 22;  // EBERR
  static constexpr std::uint32_t kEirMii = 1u << 23;
  static constexpr std::uint32_t kEirReceivedFrame = 1u << 25;  // RXF
  static constexpr std::uint32_t kEirAll = 0xffffffff;
  static constexpr std::uint32_t kRdarActive = 1u << 24;
  static constexpr std::uint32_t kTdarActive = 1u << 24;
  static constexpr std::uint32_t kEcrReset = 1u << 0;
  static constexpr std::uint32_t kEcrEtherEn = 1u << 1;
  static constexpr std::uint32_t kEcrSpeed1000 = 1u << 5;
  static constexpr std::uint32_t kEcrDescriptorSwap = 1u << 8;  // DBSWP: little-endian descriptors
  static constexpr std::uint32_t kMibcDisable = 1u << 31;
  static constexpr std::uint32_t kMibcClear = 1u << 29;           // does not clear itself
  static constexpr std::uint32_t kRcrHalfDuplexNoEcho = 1u << 1;  // DRT
  static constexpr std::uint32_t kRcrMiiMode = 1u << 2;           // "must always be set"
  static constexpr std::uint32_t kRcrRgmii = 1u << 6;
  static constexpr std::uint32_t kRcr10Mbit = 1u << 9;
  static constexpr unsigned kRcrMaxFrameShift = 16;
  static constexpr std::uint32_t kTcrFullDuplex = 1u << 2;
  static constexpr std::uint32_t kTfwrStoreAndForward = 1u << 8;
};

static_assert(offsetof(EnetRegisters, eir) == 0x004);
static_assert(offsetof(EnetRegisters, rdar) == 0x010);
static_assert(offsetof(EnetRegisters, ecr) == 0x024);
static_assert(offsetof(EnetRegisters, mmfr) == 0x040);
static_assert(offsetof(EnetRegisters, mibc) == 0x064);
static_assert(offsetof(EnetRegisters, rcr) == 0x084);
static_assert(offsetof(EnetRegisters, tcr) == 0x0c4);
static_assert(offsetof(EnetRegisters, palr) == 0x0e4);
static_assert(offsetof(EnetRegisters, opd) == 0x0ec);
static_assert(offsetof(EnetRegisters, iaur) == 0x118);
static_assert(offsetof(EnetRegisters, tfwr) == 0x144);
static_assert(offsetof(EnetRegisters, rdsr) == 0x180);
static_assert(offsetof(EnetRegisters, mrbr) == 0x188);
static_assert(offsetof(EnetRegisters, ftrl) == 0x1b0);
static_assert(offsetof(EnetRegisters, racc) == 0x1c4);
static_assert(offsetof(EnetRegisters, ieee_r_macerr) == 0x2d8);

}  // namespace iog::imx6
