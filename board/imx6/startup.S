// From the loader's last instruction to main().
//
// The machine may come out of reset (QEMU -kernel: caches and MMU off) or out of U-Boot (MMU, both
// caches, perhaps the L2 on, SCTLR 0x00c5187d). Nothing is assumed; every step says what it needs.
// Until the stacks are set, only registers hold data: while the data cache is being turned off,
// memory shows neither the cached nor the uncached truth.
//
// Names follow CMSIS startup_ARMCA9.c: Vectors, Reset_Handler, one handler for each exception.

        .syntax unified
        .arm

#include "control_registers.inc"
#include "processor_modes.inc"

        // PL310 (ARM DDI 0246): offsets, and how often a busy flag is read before giving up.
        // Cleaning 32768 dirty lines takes a few milliseconds; a million reads of a device take at
        // least 50 ms.
        .set  kPl310Control,   0x100
        .set  kPl310Sync,      0x730
        .set  kPl310CleanInvalidateWays, 0x7fc
        .set  kPl310Polls,     1000000

        .set  kWatchdogService, 0x02    // WSR

        // What an untouched word of a stack looks like (stack_gauge.hpp looks for it).
        .set  kStackPaint,     0x5ac4ed01

        .section .vectors, "ax", %progbits
        .balign 32
        .global Vectors
        .type   Vectors, %function
Vectors:
        b     Reset_Handler
        b     Undefined_Handler
        b     SVC_Handler
        b     PrefetchAbort_Handler
        b     DataAbort_Handler
        b     .                         // reserved: Hyp mode does not exist on a Cortex-A9
        b     IRQ_Handler
        b     FIQ_Handler
        .size Vectors, . - Vectors

        .text
        .global Reset_Handler
        .type   Reset_Handler, %function
Reset_Handler:
        // Supervisor mode. Interrupts are masked for ever, asynchronous aborts until there are stacks to
        // report them on, fast interrupts until the board is up (gic.hpp).
        cpsid aif, #kModeSupervisor

        // Core 0 comes up here, the others in core_start.S. Another one that comes here sleeps.
        mrc   p15, 0, r0, c0, c0, 5     // MPIDR
        ands  r0, r0, #3
        bne   park

        // Stop allocating into the data cache, leave the MMU as it is. What the loader stored (this
        // image!) may be dirty in the cache, so it is cleaned; if the cache was off, its lines are
        // whatever the power-up left in the RAMs and must be thrown away instead.
        mrc   p15, 0, r10, c1, c0, 0    // SCTLR as we were given it, kept in r10
        bic   r0, r10, #kSctlrDataCache
        mcr   p15, 0, r0, c1, c0, 0
        dsb
        isb

        // Level 1 data cache by set and way: 32-byte lines, 4 ways, so the operand is
        // way << 30 | set << 5. The number of sets comes from CCSIDR.
        mov   r0, #0
        mcr   p15, 2, r0, c0, c0, 0     // CSSELR: level 1, data
        isb
        mrc   p15, 1, r1, c0, c0, 0     // CCSIDR
        ubfx  r1, r1, #13, #15          // highest set
1:      mov   r2, #3                    // highest way
2:      mov   r3, r2, lsl #30
        orr   r3, r3, r1, lsl #5
        tst   r10, #kSctlrDataCache
        mcrne p15, 0, r3, c7, c14, 2    // DCCISW: clean and invalidate
        mcreq p15, 0, r3, c7, c6, 2     // DCISW: invalidate
        subs  r2, r2, #1
        bge   2b
        subs  r1, r1, #1
        bge   1b
        dsb

        // Level 2: with the MMU off, reads go past the PL310 to DDR, so dirty lines must get there
        // first. Cleaned and switched off only if it is on; a busy flag that never falls is given
        // up, because nobody could be told yet. start_memory() switches it on again.
        movw  r4, #:lower16:pl310
        movt  r4, #:upper16:pl310
        ldr   r0, [r4, #kPl310Control]
        tst   r0, #1
        beq   4f
        movw  r0, #0xffff               // all 16 ways
        str   r0, [r4, #kPl310CleanInvalidateWays]
        movw  r1, #(kPl310Polls & 0xffff)
        movt  r1, #(kPl310Polls >> 16)
3:      ldr   r0, [r4, #kPl310CleanInvalidateWays]
        cmp   r0, #0
        subsne r1, r1, #1
        bne   3b
        str   r0, [r4, #kPl310Sync]
        dsb
        mov   r0, #0
        str   r0, [r4, #kPl310Control]
        dsb
4:
        // MMU, instruction cache and branch prediction off, and nothing left of the loader's.
        movw  r0, #(kSctlrOff & 0xffff)
        movt  r0, #(kSctlrOff >> 16)
        mcr   p15, 0, r0, c1, c0, 0
        isb
        mov   r0, #0
        mcr   p15, 0, r0, c8, c7, 0     // TLBIALL
        mcr   p15, 0, r0, c7, c5, 0     // ICIALLU
        mcr   p15, 0, r0, c7, c5, 6     // BPIALL
        dsb
        isb

        // A loader's watchdog may have little left, and painting takes time.
        bl    serve_watchdog

        bl    start_without_errata

        // A stack for every mode that an exception can enter.
        cps   #kModeFiq
        ldr   sp, =fiq_stack_top
        cps   #kModeIrq
        ldr   sp, =irq_stack_top
        cps   #kModeAbort
        ldr   sp, =abort_stack_top
        cps   #kModeUndefined
        ldr   sp, =undefined_stack_top
        cps   #kModeSupervisor
        ldr   sp, =main_stack_top

        ldr   r0, =Vectors
        bl    start_aborts
        bl    start_neon

        // What start_memory() and the report of a fault keep. All else of the zeroed data has to wait
        // for the caches: it is up to 126 MiB.
        ldr   r0, =early_bss_begin
        ldr   r1, =early_bss_end
        bl    zero_data

        // The main stack, painted: how deep it was ever used is read off later.
        ldr   r0, =main_stack_bottom
        ldr   r1, =main_stack_top
        ldr   r2, =kStackPaint
        mov   r3, r2
        mov   r4, r2
        mov   r5, r2
5:      cmp   r0, r1
        stmialo r0!, {r2-r5}
        blo   5b

        bl    start_memory              // watchdog, MMU and caches: memory.cpp
        ldr   r0, =bss_begin
        ldr   r1, =bss_end
        bl    zero_data
        bl    main
        // main() of a firmware does not return. If it does, the watchdog speaks.
park:   wfi
        b     park
        .size Reset_Handler, . - Reset_Handler

// The service sequence of WDOG1, which means nothing to one that is off. Uses r6, r7.
        .type   serve_watchdog, %function
serve_watchdog:
        movw  r6, #:lower16:wdog1
        movt  r6, #:upper16:wdog1
        movw  r7, #0x5555
        strh  r7, [r6, #kWatchdogService]
        movw  r7, #0xaaaa
        strh  r7, [r6, #kWatchdogService]
        bx    lr
        .size serve_watchdog, . - serve_watchdog

// Zeroes from r0 to r1, which the linker script keeps on 16 bytes, and serves the watchdog every 64 KiB:
// 126 MiB may take longer than its period. Uses r2 to r8.
        .global zero_data
        .type   zero_data, %function
zero_data:
        mov   r8, lr
        mov   r2, #0
        mov   r3, #0
        mov   r4, #0
        mov   r5, #0
6:      cmp   r0, r1
        bxhs  r8
        stmia r0!, {r2-r5}
        tst   r0, #0xff00
        tsteq r0, #0xff
        bleq  serve_watchdog
        b     6b
        .size zero_data, . - zero_data

// Exceptions. No exception is expected, none returns: each one ends in report_fault() (fault.cpp),
// which prints, records and waits for the watchdog. Those of the helpers come here, too, but for
// their interrupts. The numbers are those of FaultKind in
// fault.hpp. r0 = kind, r1 = address of the instruction at fault: the link register minus what the
// ARM ARM, table B1-7, says the processor added.

        .global Undefined_Handler
        .type Undefined_Handler, %function
Undefined_Handler:
        mov   r0, #1
        sub   r1, lr, #4
        b     report
        .global SVC_Handler
        .type SVC_Handler, %function
SVC_Handler:
        mov   r0, #2
        sub   r1, lr, #4
        b     report
        .global PrefetchAbort_Handler
        .type PrefetchAbort_Handler, %function
PrefetchAbort_Handler:
        mov   r0, #3
        sub   r1, lr, #4
        b     report
        .global DataAbort_Handler
        .type DataAbort_Handler, %function
DataAbort_Handler:
        dsb                             // erratum 775420: before any ISB
        mov   r0, #4
        sub   r1, lr, #8
        b     report
        .type IRQ_Handler, %function
IRQ_Handler:
        mov   r0, #5
        sub   r1, lr, #4
        b     report
        .global FIQ_Handler
        .type FIQ_Handler, %function
FIQ_Handler:
        mov   r0, #6
        sub   r1, lr, #4

// Collects struct FaultFrame {kind, pc, spsr, lr, sp} on the stack of the mode we are in. lr and sp
// are those of Supervisor mode, because everything that can fault runs there (after an SVC its lr
// is lost).
report:
        mrs   r2, spsr
        mrs   r5, cpsr
        cps   #kModeSupervisor
        mov   r3, lr
        mov   r4, sp
        msr   cpsr_c, r5
        sub   sp, sp, #4                // with five words: the stack stays aligned to eight bytes
        push  {r0-r4}
        mov   r0, sp
        bl    report_fault
        b     park
