// Interrupts wake the loop. Running code is interrupted only to stop a helper.
//
// As on the i.MX6 (board/imx6/gic.hpp), core 0 always masks interrupts, and WFI returns when an
// interrupt is pending. The interrupts are a received frame and the 1 ms timer. TF-A reserves group
// 0 and therefore fast interrupts. For this reason, the watchdog raises no interrupt before it
// resets the chip, and an IRQ stops a helper.
#pragma once

#include "registers/gic.hpp"

namespace iog::zcu102 {

inline constexpr unsigned kInterruptTimer = 30;  // EL1 physical
inline constexpr unsigned kInterruptGem3 = 32 + 63;

// Passes only these two interrupts to core 0.
void start_gic(GicDistributorRegisters& distributor, GicCpuRegisters& cpu);

}  // namespace iog::zcu102
