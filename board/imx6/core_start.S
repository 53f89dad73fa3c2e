// What every core does to come up, and how a helper, core 1 to 3, comes up with it.
//
// The routines use registers alone, because there may be no stack yet: while the MMU is off, memory
// shows what DDR holds, and not what another core's caches hold of it.

        .syntax unified
        .arm

#include "control_registers.inc"
#include "processor_modes.inc"

        .text

// Errata of the Cortex-A9 r2p10 of the i.MX6Q, each avoided by a bit of the diagnostic register:
//   743622  bit 6   hazard checks in the store buffer may fail and corrupt data
//   751472  bit 11  an interrupted ICIALLUIS may end before all cores have done it
//   761320  bit 21  two cores that write full lines to the same region may deadlock
//   794072  bit 4   a short loop with a DMB may keep another core from its own DMB
//   845369  bit 22  a switch to streaming mode may corrupt data
//   743623  bit 20  seven PLD and an LDM from uncached memory may deadlock
// Those of bits 4, 11, 21 and 22 need several cores. Uses r0, r1.
        .global start_without_errata
        .type   start_without_errata, %function
start_without_errata:
        mrc   p15, 0, r0, c15, c0, 1
        ldr   r1, =((1 << 4) | (1 << 6) | (1 << 11) | (1 << 20) | (1 << 21) | (1 << 22))
        orr   r0, r0, r1
        mcr   p15, 0, r0, c15, c0, 1
        bx    lr
        .size start_without_errata, . - start_without_errata

// NEON: access to coprocessors 10 and 11 for privileged and user code, all 32 registers. Uses r0.
        .global start_neon
        .type   start_neon, %function
start_neon:
        mrc   p15, 0, r0, c1, c0, 2     // CPACR
        orr   r0, r0, #(0xf << 20)
        bic   r0, r0, #(3 << 30)        // ASEDIS, D32DIS
        mcr   p15, 0, r0, c1, c0, 2
        isb
        mov   r0, #(1 << 30)
        vmsr  fpexc, r0
        bx    lr
        .size start_neon, . - start_neon

// Asynchronous aborts, which nobody waits for when they come: a store to memory that is not there, or a
// parity error. One that the ROM or a loader has caused may be pending; it is taken here, says nothing
// of this firmware, and is dropped. From here on one ends the run or the helper like any other abort.
// r0: the vectors from then on. Uses r1, and the link register of Abort mode.
        .global start_aborts
        .type   start_aborts, %function
start_aborts:
        ldr   r1, =Pending_Abort_Vectors
        dsb                             // what was stored so far has its answer
        mcr   p15, 0, r1, c12, c0, 0    // VBAR, each core's own
        isb
        cpsie a
        isb
        mcr   p15, 0, r0, c12, c0, 0
        isb
        bx    lr
        .size start_aborts, . - start_aborts

        .balign 32
        .global Pending_Abort_Vectors
        .type   Pending_Abort_Vectors, %function
Pending_Abort_Vectors:
        b     .
        b     Undefined_Handler
        b     SVC_Handler
        b     PrefetchAbort_Handler
        subs  pc, lr, #8                // to where it was taken, with the state of there
        b     .
        b     .
        b     .
        .size Pending_Abort_Vectors, . - Pending_Abort_Vectors

// MMU and level 1, with the tables that core 0 has built. The snoop control unit must be on before
// ACTLR.SMP is. Table walks are cached like the tables: write-back, write-allocate, shareable (TTBR0
// bits 6, 3, 1). All of domain 0 is a client, so the permissions in the descriptors count. Uses r0, r1.
        .global start_mmu
        .type   start_mmu, %function
start_mmu:
        mov   r0, #kActlr
        mcr   p15, 0, r0, c1, c0, 1
        isb
        dsb
        mov   r1, #0
        mcr   p15, 0, r1, c2, c0, 2     // TTBCR = 0: TTBR0 for all, short descriptors
        ldr   r0, =page_tables
        orr   r0, r0, #((1 << 6) | (1 << 3) | (1 << 1))
        mcr   p15, 0, r0, c2, c0, 0     // TTBR0
        mov   r0, #1
        mcr   p15, 0, r0, c3, c0, 0     // DACR: domain 0 is a client
        mcr   p15, 0, r1, c8, c7, 0     // TLBIALL
        mcr   p15, 0, r1, c7, c5, 0     // ICIALLU
        mcr   p15, 0, r1, c7, c5, 6     // BPIALL
        dsb
        isb
        ldr   r0, =kSctlrOn
        mcr   p15, 0, r0, c1, c0, 0
        isb
        bx    lr
        .size start_mmu, . - start_mmu

// A helper begins here, out of reset by the boot ROM: MMU and caches off, secure Supervisor mode.
// Core 0 runs with all of its caches on by now.
        .global Helper_Start
        .type   Helper_Start, %function
Helper_Start:
        cpsid aif, #kModeSupervisor
        ldr   r0, =kSctlrOff
        mcr   p15, 0, r0, c1, c0, 0
        isb

        // The level 1 data cache holds whatever the power-up left: invalidated by set and way, 32-byte
        // lines, 4 ways, the operand is way << 30 | set << 5. The number of sets comes from CCSIDR.
        // This reaches this core's own cache and no other.
        mov   r0, #0
        mcr   p15, 2, r0, c0, c0, 0     // CSSELR: level 1, data
        isb
        mrc   p15, 1, r1, c0, c0, 0     // CCSIDR
        ubfx  r1, r1, #13, #15          // highest set
1:      mov   r2, #3                    // highest way
2:      mov   r3, r2, lsl #30
        orr   r3, r3, r1, lsl #5
        mcr   p15, 0, r3, c7, c6, 2     // DCISW
        subs  r2, r2, #1
        bge   2b
        subs  r1, r1, #1
        bge   1b
        dsb

        bl    start_without_errata
        bl    start_mmu
        bl    start_neon

        // Two stacks: one for Supervisor mode, one for exceptions, of which the first ends the helper.
        mrc   p15, 0, r0, c0, c0, 5     // MPIDR
        and   r0, r0, #3
        sub   r0, r0, #1                // the linker's symbols are those of core 1
        ldr   r1, =helper_stack_stride
        mul   r0, r0, r1
        ldr   r1, =helper_exception_stack_top
        add   r1, r1, r0
        ldr   r2, =helper_main_stack_top
        add   r2, r2, r0
        cps   #kModeFiq
        mov   sp, r1
        cps   #kModeIrq
        mov   sp, r1
        cps   #kModeAbort
        mov   sp, r1
        cps   #kModeUndefined
        mov   sp, r1
        cps   #kModeSupervisor
        mov   sp, r2

        ldr   r0, =Helper_Vectors
        bl    start_aborts
        bl    run_helper
        b     .
        .size Helper_Start, . - Helper_Start

// As Vectors of startup.S, but for interrupts.
        .balign 32
        .type   Helper_Vectors, %function
Helper_Vectors:
        b     .                         // a reset goes to the boot ROM
        b     Undefined_Handler
        b     SVC_Handler
        b     PrefetchAbort_Handler
        b     DataAbort_Handler
        b     .                         // reserved
        b     Helper_Interrupt
        b     FIQ_Handler
        .size Helper_Vectors, . - Helper_Vectors

        .set  kGicIar,  0x0c
        .set  kGicEoir, 0x10
        .set  kInterruptStop, 1         // as in helper.hpp

// Acknowledges the interrupt. A wake has done its work by coming: it ended a sleep, or the count says
// that there was one. The stop does not return.
        .type Helper_Interrupt, %function
Helper_Interrupt:
        push  {r0, r1}
        ldr   r1, =gic_cpu
        ldr   r0, [r1, #kGicIar]
        str   r0, [r1, #kGicEoir]
        ubfx  r0, r0, #0, #10
        cmp   r0, #kInterruptStop
        pop   {r0, r1}
        subsne pc, lr, #4
        sub   r0, lr, #4
        b     stop_helper
        .size Helper_Interrupt, . - Helper_Interrupt
