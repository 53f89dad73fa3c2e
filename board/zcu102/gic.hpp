// Interrupts wake the loop. They interrupt running code only to stop a helper.
//
// As on the i.MX6 (board/imx6/gic.hpp), core 0 always masks interrupts, and WFI returns when one is
// pending: a received frame, or the 1 ms timer. TF-A reserves group 0 and therefore fast
// interrupts. The watchdog thus raises no interrupt before it resets the chip, and a helper is
// stopped by an IRQ.
#pragma once

#include "registers/gic.hpp"

namespace iog::zcu102 {

inline constexpr unsigned kInterruptTimer = 30;  // EL1 physical
inline constexpr unsigned kInterruptGem3 = 32 + 63;

// Passes exactly these two interrupts to core 0.
void start_gic(GicDistributorRegisters& distributor, GicCpuRegisters& cpu);

}  // namespace iog::zcu102
