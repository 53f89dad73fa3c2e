// On-Chip OTP Controller, i.MX6DQRM chapter "On-Chip OTP Controller (OCOTP_CTRL)". At reset, the
// boot ROM copies the fuses to these shadow registers.
#pragma once

#include <cstddef>

#include "registers/register.hpp"

namespace iog::imx6 {

struct OcotpRegisters {
  Gap<0x000, 0x4e0> gap_000;
  Ro32 ana1;  // calibration of the temperature monitor
  Gap<0x4e4, 0x620> gap_4e4;
  Ro32 mac0;  // octets 2 to 5 of the address, the last in the low byte
  Gap<0x624, 0x630> gap_624;
  Ro32 mac1;  // octets 0 and 1 in the low half
};

static_assert(offsetof(OcotpRegisters, ana1) == 0x4e0);
static_assert(offsetof(OcotpRegisters, mac0) == 0x620);
static_assert(offsetof(OcotpRegisters, mac1) == 0x630);

}  // namespace iog::imx6
