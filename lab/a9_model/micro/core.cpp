// Chains of dependent core instructions, and independent ones. A turn of a loop has 64 of them, so
// that the loop itself does not count.
#include "micro.hpp"

namespace iog::a9_model::micro {
namespace {

constexpr std::uint32_t kTurns = 1000;
constexpr std::uint32_t kPerTurn = 64;

// kBody is repeated `times` times, registers r0 to r11 are its own; r0 holds an address of 4 KB.
#define A9_MICRO_LOOP(times, body)                                                     \
  [] {                                                                                 \
    std::uint32_t turns = kTurns;                                                      \
    alignas(4096) static std::uint32_t memory[1024];                                   \
    __asm__ volatile(                                                                  \
        "mov r0, %1\n\tmov r1, #1\n\tmov r2, #0\n\tmov r3, #3\n\t"                     \
        "mov r4, #4\n\tmov r5, #5\n\tmov r6, #6\n\tmov r7, #7\n\tmov r8, r0\n\t"       \
        "str r0, [r0]\n\tstr r2, [r0, #8]\n"                                           \
        ".p2align 3\n1:\n\t.rept " #times "\n\t" body                                  \
        "\n\t.endr\n\t"                                                                \
        "subs %0, %0, #1\n\tbne 1b"                                                    \
        : "+r"(turns)                                                                  \
        : "r"(memory)                                                                  \
        : "r0", "r1", "r2", "r3", "r4", "r5", "r6", "r7", "r8", "r9", "cc", "memory"); \
    return kTurns * kPerTurn;                                                          \
  }

}  // namespace

void measure_core() {
  measure<1>("alu_chain", A9_MICRO_LOOP(64, "add r1, r1, r2"));
  measure<2>("alu_independent",
             A9_MICRO_LOOP(16,
                           "add r1, r1, r2\n\tadd r3, r3, r2\n\tadd r4, r4, r2\n\t"
                           "add r5, r5, r2"));
  measure<3>("shift_chain", A9_MICRO_LOOP(64, "add r1, r1, r2, lsl #1"));
  measure<4>("register_shift_chain", A9_MICRO_LOOP(64, "add r1, r1, r2, lsl r3"));
  measure<5>("saturate_chain", A9_MICRO_LOOP(64, "usat r1, #8, r1"));
  measure<6>("saturating_add_chain", A9_MICRO_LOOP(64, "uqadd8 r1, r1, r2"));
  measure<7>("extend_chain", A9_MICRO_LOOP(64, "uxtb r1, r1"));
  measure<8>("multiply_chain", A9_MICRO_LOOP(64, "mul r1, r1, r3"));
  measure<9>("multiply_independent",
             A9_MICRO_LOOP(16,
                           "mul r1, r2, r3\n\tmul r4, r2, r3\n\tmul r5, r2, r3\n\t"
                           "mul r6, r2, r3"));
  measure<10>("multiply_long_chain", A9_MICRO_LOOP(64, "umull r1, r4, r1, r3"));
  measure<11>("multiply_16_chain", A9_MICRO_LOOP(64, "smulbb r1, r1, r3"));
  measure<12>("load_chain", A9_MICRO_LOOP(64, "ldr r0, [r0]"));
  measure<13>("load_add_chain", A9_MICRO_LOOP(64, "ldr r1, [r0]\n\tadd r0, r1, r2"));
  measure<14>("load_independent", A9_MICRO_LOOP(64, "ldr r1, [r0]"));
  measure<15>("load_byte_independent", A9_MICRO_LOOP(64, "ldrb r1, [r0]"));
  measure<16>("load_eight_registers", A9_MICRO_LOOP(64, "ldm r0, {r1-r7, r9}"));
  measure<17>("load_eight_misaligned", A9_MICRO_LOOP(32,
                                                     "add r8, r0, #4\n\tldm r8, {r1-r7, r9}\n\t"
                                                     "add r8, r0, #4\n\tldm r8, {r1-r7, r9}"));
  measure<18>("load_across_doubleword", A9_MICRO_LOOP(64,
                                                      "ldr r1, [r0, #6]\n\tand r1, r1, r2\n\t"
                                                      "add r0, r0, r1"));
  measure<19>("store_independent", A9_MICRO_LOOP(64, "str r1, [r0, #16]"));
  measure<20>("store_load_chain", A9_MICRO_LOOP(64, "str r0, [r8, #16]\n\tldr r0, [r8, #16]"));
  measure<21>("add_beside_load", A9_MICRO_LOOP(64, "ldr r1, [r0]\n\tadd r3, r3, r2"));
  measure<22>("conditional_chain", A9_MICRO_LOOP(64, "addne r1, r1, r2"));
}

}  // namespace iog::a9_model::micro
