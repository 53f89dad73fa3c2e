// Interrupts wake the loop; nothing is ever interrupted, but for one that ends it.
//
// On core 0 the firmware is one loop; the interrupts of the other cores are in helper.hpp. CPSR
// masks interrupts from the first instruction on, and nothing unmasks them. The GIC passes three
// interrupts to the core all the same, because WFI returns when an interrupt is pending, masked or
// not (ARM ARM B1.8.13): a received frame, the 1 ms tick, and a transmitter of UART1 that has room
// while bytes wait for it.
//
// After waking, the loop first clears the event flags of frame and tick in their devices and then
// polls everything. The order matters: an event between the two is found by the poll, and an event
// after the poll ends the next WFI at once. The UART's interrupt goes away when its FIFO is filled.
// All three are level-triggered, so the GIC follows the flags and is never acknowledged.
//
// There is no interrupt handler, no critical section and no variable shared between two flows. An
// exception of kind IRQ means that interrupts were unmasked: it is a fault like any other.
//
// The watchdog's interrupt comes half a second before it resets the chip, as a fast one, which core
// 0 does not mask: so a loop that hangs is interrupted wherever it is, and leaves a last word that
// says where. Nothing comes back from it, so it shares nothing with what it interrupts.
#pragma once

#include "registers/gic.hpp"

namespace iog::imx6 {

inline constexpr unsigned kInterruptUart1 = 32 + 26;
inline constexpr unsigned kInterruptEpit1 = 32 + 56;
inline constexpr unsigned kInterruptEnet = 32 + 118;
inline constexpr unsigned kInterruptWatchdog = 32 + 80;

// Lets exactly these four through to core 0.
void start_gic(GicDistributorRegisters& distributor, GicCpuRegisters& cpu);

}  // namespace iog::imx6
