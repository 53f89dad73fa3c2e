// Interrupts wake the loop. Only the watchdog's interrupt stops running code, and this interrupt
// ends the run.
//
// On core 0, the firmware is one loop. `helper.hpp` describes the interrupts of the other cores.
// CPSR masks interrupts from the first instruction, and no code unmasks them. The GIC still passes
// three interrupts to core 0, because WFI returns when an interrupt is pending, even if the
// interrupt is masked (ARM ARM B1.8.13). The three interrupts are a received frame, the 1 ms tick,
// and room in UART1's transmitter while bytes wait.
//
// After waking, the loop first clears the event flags of frame and tick in the devices, and then
// polls all devices. This order loses no event. The poll finds an event between the two steps, and
// an event after the poll ends the next WFI immediately. The UART's interrupt ends when the UART's
// FIFO is full. All three interrupts are level-triggered, so the GIC follows the flags and needs no
// acknowledgement.
//
// The firmware has no interrupt handler, no critical section, and no variable that two flows of
// control share. An IRQ exception means that interrupts were unmasked, and is treated as a fault.
//
// The watchdog raises a fast interrupt half a second before it resets the chip. Core 0 does not
// mask fast interrupts, so the watchdog interrupts a hanging loop at any point. The handler stores
// a last word with the location. The handler never returns, so it shares no data with the
// interrupted code.
#pragma once

#include "registers/gic.hpp"

namespace iog::imx6 {

inline constexpr unsigned kInterruptUart1 = 32 + 26;
inline constexpr unsigned kInterruptEpit1 = 32 + 56;
inline constexpr unsigned kInterruptEnet = 32 + 118;
inline constexpr unsigned kInterruptWatchdog = 32 + 80;

// Passes only these four interrupts to core 0.
void start_gic(GicDistributorRegisters& distributor, GicCpuRegisters& cpu);

}  // namespace iog::imx6
