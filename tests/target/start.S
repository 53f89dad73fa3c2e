// Start-up of a test image on the Cortex-A9, in front of newlib's own `_start`.
//
// QEMU enters here in secure supervisor mode with caches, MMU and FPU off. newlib's start-up code
// already saves FPU registers, so the FPU has to be on before it. The vectors are set as well:
// without them an exception would run into the boot ROM's zeroes and look like a hang.

        .syntax unified
        .arch   armv7-a
        .fpu    neon
        .arm
        .section .text.test_image_start, "ax", %progbits

        .global test_image_start
        .type   test_image_start, %function
test_image_start:
        // CPACR: full access to coprocessors 10 and 11, which are VFP and NEON.
        mrc     p15, 0, r0, c1, c0, 2
        orr     r0, r0, #(0xf << 20)
        mcr     p15, 0, r0, c1, c0, 2
        isb
        // FPEXC.EN: VFP and NEON instructions execute instead of trapping.
        mov     r0, #(1 << 30)
        vmsr    fpexc, r0
        // VBAR: exceptions of this image go to the table below.
        ldr     r0, =vectors
        mcr     p15, 0, r0, c12, c0, 0
        isb
        b       _start
        .size   test_image_start, . - test_image_start

// Every exception ends the run with a status that names it; no test image expects any. The offsets
// are those of the architecture: reset, undefined, supervisor call, prefetch abort, data abort,
// (unused), interrupt, fast interrupt. Semihosting calls do not come here, QEMU takes them before.
        .balign 32
vectors:
        b       .
        b       undefined_instruction
        b       .
        b       prefetch_abort
        b       data_abort
        b       .
        b       interrupt
        b       interrupt

undefined_instruction:
        mov     r2, #101
        b       exit_with_status
prefetch_abort:
        mov     r2, #102
        b       exit_with_status
data_abort:
        mov     r2, #103
        b       exit_with_status
interrupt:
        mov     r2, #104

// Semihosting SYS_EXIT_EXTENDED (0x20) with the block {ADP_Stopped_ApplicationExit, status in r2}.
exit_with_status:
        ldr     r1, =exit_block
        str     r2, [r1, #4]
        mov     r0, #0x20
        svc     0x123456
        b       .

        .section .data.exit_block, "aw", %progbits
        .balign 4
exit_block:
        .word   0x20026
        .word   0
