// Interrupts wake the loop; nothing is ever interrupted, but a helper that is stopped.
//
// As on the i.MX6 (board/imx6/gic.hpp) core 0 masks interrupts for ever, and WFI returns when one
// is pending: a received frame, or the timer's millisecond. TF-A keeps group 0, and so fast
// interrupts, for itself: there is no interrupt before a reset by the watchdog, and a helper is
// stopped by IRQ.
#pragma once

#include "registers/gic.hpp"

namespace iog::zcu102 {

inline constexpr unsigned kInterruptTimer = 30;  // EL1 physical
inline constexpr unsigned kInterruptGem3 = 32 + 63;

// Lets exactly these two through to core 0.
void start_gic(GicDistributorRegisters& distributor, GicCpuRegisters& cpu);

}  // namespace iog::zcu102
