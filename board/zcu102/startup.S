// From the loader's last instruction to main(), for core 0 and for the helpers.
//
// A loader hands over at EL2 (U-Boot behind TF-A) or EL1, with MMU and caches on or off. The firmware runs at EL1, on
// SP_EL0; exceptions are taken on SP_EL1. PSCI starts a helper at the level of core 0, MMU off.

        .set  kSctlrOff, 0x30d00800     // ARM ARM D13.2.118: the bits that must be one
        // MMU, both caches, stack alignment, and what may be written is never executed
        .set  kSctlrOn,  kSctlrOff | 1 << 0 | 1 << 2 | 1 << 3 | 1 << 12 | 1 << 19
        // Attributes 0: device nGnRE, 1: normal write-back, 2: normal not cached (memory/mmu.hpp)
        .set  kMair,     0x44ff04
        // T0SZ: 4 GiB, from level 1; walks write-back, inner shareable; 4 KiB granule; nothing by TTBR1
        .set  kTcr,      32 | 1 << 8 | 1 << 10 | 3 << 12 | 1 << 23
        .set  kStackPaint, 0x5ac4ed01   // stack_gauge.hpp looks for it
        .set  kSpsrEl1t, 0x3c4          // EL1 on SP_EL0, all masked

        .section .vectors, "ax", %progbits
        .global _start
        .type   _start, %function
_start:
        msr   daifset, #0xf
        mrs   x0, mpidr_el1
        tst   x0, #0xff
        b.ne  park                      // PSCI starts the others
        bl    clean_caches
        bl    enter_el1
        ldr   x0, =exception_stack_top
        mov   sp, x0
        msr   spsel, #0
        ldr   x0, =main_stack_top
        mov   sp, x0
        ldr   x0, =early_bss_begin
        ldr   x1, =early_bss_end
        bl    zero_data
        // The main stack, painted: how deep it was ever used is read off later.
        ldr   x0, =main_stack_bottom
        ldr   x1, =main_stack_top
        ldr   w2, =kStackPaint
        orr   x2, x2, x2, lsl #32
1:      stp   x2, x2, [x0], #16
        cmp   x0, x1
        b.lo  1b
        bl    start_memory              // tables: memory.cpp
        bl    start_mmu
        ldr   x0, =bss_begin
        ldr   x1, =bss_end
        bl    zero_data
        bl    main
        b     park
        .size _start, . - _start
        .ltorg

        // The sixteen entries of 128 bytes; those of the running level on SP_EL0 come first.
        .balign 2048
        .global vectors
        .type   vectors, %object
vectors:
        .irp  from, 0, 1, 2, 3
        .balign 128                     // synchronous
        stp   x0, x1, [sp, #-32]!
        stp   x2, x3, [sp, #16]
        b     synchronous
        .balign 128                     // IRQ
        stp   x0, x1, [sp, #-32]!
        stp   x2, x3, [sp, #16]
        b     interrupt
        .balign 128                     // FIQ
        mov   x0, #6
        b     report
        .balign 128                     // SError
        mov   x0, #7
        b     report
        .endr
        .balign 128
        .size vectors, . - vectors

        .text
// Kinds as in fault.hpp, by the class of the exception (ESR_EL1, ARM ARM D13.2.37).
        .type synchronous, %function
synchronous:
        mrs   x1, esr_el1
        lsr   x1, x1, #26
        mov   x0, #2
        cmp   x1, #0x15                 // SVC
        b.eq  report
        mov   x0, #3
        cmp   x1, #0x21                 // instruction abort
        b.eq  report
        mov   x0, #4
        cmp   x1, #0x25                 // data abort
        b.eq  report
        mov   x0, #8
        cmp   x1, #0x22                 // PC alignment
        b.eq  report
        cmp   x1, #0x26                 // SP alignment
        b.eq  report
        mov   x0, #1                    // all else is an instruction that cannot be executed
        b     report
        .size synchronous, . - synchronous

// On a helper: acknowledges the interrupt. A wake has done its work by coming; the stop does not return. Core 0 has
// no interrupt that is taken.
        .type interrupt, %function
interrupt:
        mrs   x0, mpidr_el1
        tst   x0, #0xff
        mov   x0, #5
        b.eq  report
        ldr   x1, =gic_cpu
        ldr   w2, [x1, #0x0c]           // GICC_IAR
        str   w2, [x1, #0x10]           // GICC_EOIR
        and   w2, w2, #0x3ff
        mrs   x0, elr_el1
        cmp   w2, #1                    // kInterruptStop of helper.hpp
        b.eq  stop_helper
        ldp   x2, x3, [sp, #16]
        ldp   x0, x1, [sp], #32
        eret
        .size interrupt, . - interrupt

// Collects struct FaultFrame {kind, pc, spsr, lr, sp, esr, far}; x0 has the kind.
        .type report, %function
report:
        mrs   x1, elr_el1
        mrs   x2, spsr_el1
        mrs   x4, sp_el0
        mrs   x5, esr_el1
        mrs   x6, far_el1
        sub   sp, sp, #64
        stp   x0, x1, [sp]
        stp   x2, x30, [sp, #16]
        stp   x4, x5, [sp, #32]
        str   x6, [sp, #48]
        mov   x0, sp
        bl    report_fault
park:   wfi
        b     park
        .size report, . - report

// A helper, started by PSCI.
        .global Helper_Start
        .type   Helper_Start, %function
Helper_Start:
        msr   daifset, #0xf
        bl    enter_el1
        mrs   x0, mpidr_el1
        and   x0, x0, #0xff
        sub   x0, x0, #1                // the linker's symbols are those of core 1
        ldr   x1, =helper_stack_stride
        mul   x0, x0, x1
        ldr   x1, =helper_exception_stack_top
        add   x1, x1, x0
        mov   sp, x1
        msr   spsel, #0
        ldr   x1, =helper_main_stack_top
        add   x1, x1, x0
        mov   sp, x1
        bl    start_mmu
        bl    run_helper
        b     park
        .size Helper_Start, . - Helper_Start

// To EL1 if we are at EL2, with vectors, NEON, and MMU and caches off. Uses x0, x1; returns on SP_EL1.
        .type enter_el1, %function
enter_el1:
        ldr   x1, =kSctlrOff
        mrs   x0, currentel
        cmp   x0, #2 << 2
        b.ne  2f
        mov   x0, #1 << 31              // HCR_EL2.RW: EL1 is AArch64, its interrupts are its own
        msr   hcr_el2, x0
        mov   x0, #0x33ff               // CPTR_EL2: no trap of NEON
        msr   cptr_el2, x0
        mov   x0, #3                    // CNTHCTL_EL2: the physical counter and timer are EL1's, too
        msr   cnthctl_el2, x0
        msr   cntvoff_el2, xzr
        msr   sctlr_el1, x1
        mov   x0, #kSpsrEl1t | 1        // EL1 on SP_EL1
        msr   spsr_el2, x0
        adr   x0, 2f
        msr   elr_el2, x0
        eret
2:      msr   spsel, #1
        msr   sctlr_el1, x1
        isb
        ic    iallu
        tlbi  vmalle1
        ldr   x0, =vectors
        msr   vbar_el1, x0
        mov   x0, #3 << 20              // CPACR_EL1.FPEN
        msr   cpacr_el1, x0
        dsb   sy
        isb
        msr   daifclr, #4               // system errors are heard from here on
        ret
        .size enter_el1, . - enter_el1

// What the loader stored (this image!) may be dirty in the caches: cleaned by set and way, level by level (ARM ARM
// D4.4.8), with this level's data cache off. Uses x0 to x9.
        .type clean_caches, %function
clean_caches:
        mrs   x0, currentel
        cmp   x0, #2 << 2
        b.eq  1f
        mrs   x1, sctlr_el1
        bic   x1, x1, #1 << 2
        msr   sctlr_el1, x1
        b     2f
1:      mrs   x1, sctlr_el2
        bic   x1, x1, #1 << 2
        msr   sctlr_el2, x1
2:      isb
        mrs   x0, clidr_el1
        mov   x1, #0                    // level << 1
3:      add   x2, x1, x1, lsr #1
        lsr   x2, x0, x2
        and   x2, x2, #7
        cbz   x2, 7f                    // no cache here, nor behind
        cmp   x2, #2
        b.lt  6f                        // instructions alone
        msr   csselr_el1, x1
        isb
        mrs   x2, ccsidr_el1
        and   x3, x2, #7
        add   x3, x3, #4                // log2 of the line
        ubfx  x4, x2, #3, #10           // highest way
        ubfx  x5, x2, #13, #15          // highest set
        clz   w6, w4                    // where the way's number begins
4:      mov   x7, x5
5:      lsl   w8, w4, w6
        lsl   w9, w7, w3
        orr   w8, w8, w9
        orr   w8, w8, w1
        dc    cisw, x8
        subs  x7, x7, #1
        b.ge  5b
        subs  x4, x4, #1
        b.ge  4b
6:      add   x1, x1, #2
        cmp   x1, #14
        b.lt  3b
7:      msr   csselr_el1, xzr
        dsb   sy
        isb
        ret
        .size clean_caches, . - clean_caches

// MMU and caches, with the tables that core 0 has built. Uses x0.
        .global start_mmu
        .type   start_mmu, %function
start_mmu:
        dsb   sy
        ldr   x0, =kMair
        msr   mair_el1, x0
        ldr   x0, =kTcr
        msr   tcr_el1, x0
        ldr   x0, =page_tables
        msr   ttbr0_el1, x0
        tlbi  vmalle1
        ic    iallu
        dsb   sy
        isb
        ldr   x0, =kSctlrOn
        msr   sctlr_el1, x0
        isb
        ret
        .size start_mmu, . - start_mmu

// Zeroes from x0 to x1, which the linker script keeps on 16 bytes.
        .type zero_data, %function
zero_data:
        cmp   x0, x1
        b.hs  1f
        stp   xzr, xzr, [x0], #16
        b     zero_data
1:      ret
        .size zero_data, . - zero_data
