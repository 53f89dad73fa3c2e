// Interrupts wake the loop; nothing is ever interrupted.
//
// The whole firmware is one loop on one core. CPSR masks interrupts from the first instruction on
// and nothing unmasks them. The GIC is set up so that three lines reach the core all the same,
// because WFI returns when a line is pending, masked or not (ARM ARM B1.8.13): a received frame,
// the 1 ms tick, and a transmitter of UART1 that has room while bytes wait for it. After waking,
// the loop clears the event flags of the first two in their devices and then polls everything, in
// this order: an event between the two is found by the poll, and one after the poll ends the next
// WFI at once. The UART's line falls when its FIFO is filled. All are level-triggered, so the GIC
// follows the flags and is never acknowledged.
//
// There is no interrupt handler, no critical section and no variable shared between two flows. An
// exception of kind IRQ means that somebody unmasked interrupts: it is a fault like any other.
#pragma once

#include "registers/gic.hpp"

namespace iog::imx6 {

inline constexpr unsigned kInterruptUart1 = 32 + 26;
inline constexpr unsigned kInterruptEpit1 = 32 + 56;
inline constexpr unsigned kInterruptEnet = 32 + 118;

// Lets exactly these three through to core 0.
void start_gic(GicDistributorRegisters& distributor, GicCpuRegisters& cpu);

}  // namespace iog::imx6
