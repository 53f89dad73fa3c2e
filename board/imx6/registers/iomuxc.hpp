// IOMUX Controller and GPIO, i.MX6DQRM chapters "IOMUX Controller (IOMUXC)" and "General Purpose
// Input/Output (GPIO)". A pad is named by the offsets of its registers, so IOMUXC is one array of
// words.
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct IomuxcRegisters {
  static constexpr std::size_t kBytes = 0x94c;
  Rw32 words[kBytes / 4];

  Rw32& at(std::uint32_t offset) { return words[offset / 4]; }

  static constexpr std::uint32_t kGpr1 = 0x004;
  static constexpr std::uint32_t kGpr1EnetClkSel = 1u << 21;
};

struct GpioRegisters {
  Rw32 dr;
  Rw32 gdir;
  Ro32 psr;
};

static_assert(offsetof(GpioRegisters, gdir) == 0x04);

}  // namespace iog::imx6
