// A loader that leaves the machine in a state that it is told, and starts the firmware.
//
// QEMU starts it as a loader is started: Supervisor mode, secure, MMU and caches off. What it leaves
// stands at loader_state, where QEMU has put it (loader_states_test): two addresses, between which
// memory is filled with noise, and a word of one bit each:

        .syntax unified
        .arm

        .set  kMmuAndCaches,  1 << 0    // as U-Boot: flat, SCTLR 0x00c5187d
        .set  kOddControl,    1 << 1    // alignment check, high vectors, TEX remap, access flag, Thumb,
                                        // SWP, round-robin replacement
        .set  kBigEndian,     1 << 2    // exceptions big-endian, which holds for table walks too
        .set  kL2,            1 << 3    // the PL310 says that it is on
        .set  kPending,       1 << 4    // timers run, their interrupts are enabled and wait
        .set  kShortWatchdog, 1 << 5    // of a second's watchdog 20 ms are left
        .set  kLongWatchdog,  1 << 6    // the watchdog waits for 128 s
        .set  kSystemMode,    1 << 7    // System mode, all interrupts unmasked, no stack
        .set  kNonSecure,     1 << 8    // as U-Boot leaves it for Linux: all interrupts in group 1

        .set  kNoise, 0xa5a5a5a5

        .set  kModeMonitor,    0x16
        .set  kModeSupervisor, 0x13
        .set  kModeSystem,     0x1f
        .set  kTables,   0x17e00000     // behind the stub, before the end of the first 128 MiB
        .set  kFirmware, 0x10100000

        .text
        .global loader
loader:
        ldr   r0, =loader_state
        ldm   r0, {r1, r2, r11}         // noise from, noise to, state

        // What a loader or the power-up leaves where the image has no content. QEMU's memory is zero.
        ldr   r3, =kNoise
0:      cmp   r1, r2
        strlo r3, [r1], #4
        blo   0b

        tst   r11, #kL2
        ldrne r0, =pl310
        movne r1, #1
        strne r1, [r0, #0x100]          // control

        tst   r11, #kPending
        beq   1f
        ldr   r0, =gpt
        ldr   r1, =0x043                // EN, ENMOD, CLKSRC 1, restart mode
        str   r1, [r0]
        mov   r1, #1
        str   r1, [r0, #0x0c]           // IR: compare 1
        ldr   r1, =66000                // 1 ms, as for the others
        str   r1, [r0, #0x10]           // OCR1
        ldr   r0, =epit1
        ldr   r1, =0x0102000f           // CLKSRC 1, IOVW, RLD, OCIEN, ENMOD, EN
        str   r1, [r0]
        ldr   r1, =66000
        str   r1, [r0, #0x08]           // LR
        ldr   r0, =0x00a00600           // the private timer, interrupt 29
        ldr   r1, =100000
        str   r1, [r0]
        mov   r1, #7                    // enable, reload, interrupt
        str   r1, [r0, #8]
        ldr   r0, =gic_distributor
        mvn   r1, #0
        str   r1, [r0, #0x100]          // ISENABLER0: private ones
        str   r1, [r0, #0x108]          // ISENABLER2: GPT is 87, EPIT1 is 88
        mov   r1, #3
        str   r1, [r0]
        ldr   r0, =gic_cpu
        mov   r1, #0xff
        str   r1, [r0, #4]
        mov   r1, #1
        str   r1, [r0]
        ldr   r1, =62500                // 2 ms in a loop of two instructions of 16 ns each
0:      subs  r1, r1, #1
        bne   0b
1:
        // One second, of which the same loop passes 980 ms.
        tst   r11, #kShortWatchdog
        beq   3f
        ldr   r0, =wdog1
        ldr   r1, =0x0134
        strh  r1, [r0]
        ldr   r1, =30625000
2:      subs  r1, r1, #1
        bne   2b
3:
        tst   r11, #kLongWatchdog
        beq   4f
        ldr   r0, =wdog1
        ldr   r1, =0xff34
        strh  r1, [r0]
4:
        tst   r11, #kMmuAndCaches
        beq   6f
        ldr   r0, =kTables
        mov   r1, #0                    // section
        ldr   r2, =0xc0e                // any access, write-back
5:      orr   r3, r2, r1, lsl #20
        str   r3, [r0, r1, lsl #2]
        add   r1, r1, #1
        cmp   r1, #4096
        bne   5b
        mov   r1, #0
        mcr   p15, 0, r1, c2, c0, 2     // TTBCR
        mcr   p15, 0, r0, c2, c0, 0     // TTBR0
        mov   r1, #3
        mcr   p15, 0, r1, c3, c0, 0     // DACR: manager
        mcr   p15, 0, r1, c8, c7, 0     // TLBIALL
        dsb
        isb
        ldr   r1, =0x00c5187d
        mcr   p15, 0, r1, c1, c0, 0
        isb
6:
        tst   r11, #kNonSecure
        beq   7f
        ldr   r0, =0x60c00              // NSACR: coprocessors 10 and 11, ACTLR.SMP
        mcr   p15, 0, r0, c1, c1, 2
        ldr   r0, =gic_distributor
        mvn   r1, #0
        str   r1, [r0, #0x80]
        str   r1, [r0, #0x84]
        str   r1, [r0, #0x88]
        str   r1, [r0, #0x8c]
        str   r1, [r0, #0x90]           // IGROUPR0 to 4
        mov   r1, #3
        str   r1, [r0]
        ldr   r0, =gic_cpu
        mov   r1, #0xff
        str   r1, [r0, #4]
        mov   r1, #3
        str   r1, [r0]
        cps   #kModeMonitor
        mrc   p15, 0, r0, c1, c1, 0     // SCR
        orr   r0, r0, #1                // NS
        mcr   p15, 0, r0, c1, c1, 0
        isb
        cps   #kModeSupervisor
7:
        mrc   p15, 0, r0, c1, c0, 0
        tst   r11, #kOddControl
        ldrne r1, =0x70006402
        orrne r0, r0, r1
        tst   r11, #kBigEndian
        orrne r0, r0, #(1 << 25)
        mcr   p15, 0, r0, c1, c0, 0
        isb

        ldr   r12, =kFirmware
        tst   r11, #kSystemMode
        beq   8f
        cps   #kModeSystem
        cpsie aif
        mov   sp, #0
8:      bx    r12
