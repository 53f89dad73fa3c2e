// Chains and sequences of VFP and Advanced SIMD instructions.
#include "micro.hpp"

namespace iog::a9_model::micro {
namespace {

constexpr std::uint32_t kTurns = 1000;
constexpr std::uint32_t kPerTurn = 64;

#define A9_MICRO_VECTOR_LOOP(times, body)                                              \
  [] {                                                                                 \
    std::uint32_t turns = kTurns;                                                      \
    __asm__ volatile(                                                                  \
        "vmov.i32 q0, #0\n\tvmov.i32 q1, #0\n\tvmov.i32 q2, #0\n\tvmov.i32 q3, #0\n\t" \
        "vmov.i32 q4, #0\n\tvmov.f32 s0, #1.0\n\tvmov.f32 s1, #1.0\n"                  \
        ".p2align 3\n1:\n\t.rept " #times "\n\t" body                                  \
        "\n\t.endr\n\t"                                                                \
        "subs %0, %0, #1\n\tbne 1b"                                                    \
        : "+r"(turns)                                                                  \
        :                                                                              \
        : "q0", "q1", "q2", "q3", "q4", "r2", "cc");                                   \
    return kTurns * kPerTurn;                                                          \
  }

// The loop of "The computing power of the four Cortex-A9 cores in i.MX6 Q", community.nxp.com,
// thread 305349: five products of q registers, a counter and a branch.
std::uint32_t multiply_add_five() {
  std::uint32_t turns = kTurns * kPerTurn;
  __asm__ volatile(
      "vmov.i32 q0, #0\n\tvmov.i32 q1, #0\n\tvmov.i32 q2, #0\n\tvmov.i32 q3, #0\n\t"
      "vmov.i32 q4, #0\n"
      "1:\n\tvmla.f32 q0, q1, q1\n\tvmla.f32 q1, q2, q2\n\tvmla.f32 q2, q3, q3\n\t"
      "vmla.f32 q3, q4, q4\n\tvmla.f32 q4, q2, q2\n\t"
      "subs %0, %0, #1\n\tbge 1b"
      : "+r"(turns)
      :
      : "q0", "q1", "q2", "q3", "q4", "cc");
  return kTurns * kPerTurn;
}

}  // namespace

void measure_vectors() {
  measure<100>("vfp_add_chain", A9_MICRO_VECTOR_LOOP(64, "vadd.f32 s0, s0, s1"));
  measure<101>("vfp_multiply_chain", A9_MICRO_VECTOR_LOOP(64, "vmul.f32 s0, s0, s1"));
  measure<102>("vfp_multiply_add_chain", A9_MICRO_VECTOR_LOOP(64, "vmla.f32 s0, s0, s1"));
  measure<103>("vfp_divide_chain", A9_MICRO_VECTOR_LOOP(64, "vdiv.f32 s0, s0, s1"));
  measure<104>("vfp_double_add_chain", A9_MICRO_VECTOR_LOOP(64, "vadd.f64 d0, d0, d1"));
  measure<105>("vfp_compare_flags",
               A9_MICRO_VECTOR_LOOP(64,
                                    "vcmp.f32 s0, s1\n\tvmrs apsr_nzcv, fpscr\n\t"
                                    "addne r2, r2, #1"));
  measure<106>("neon_add_chain", A9_MICRO_VECTOR_LOOP(64, "vadd.i8 q0, q0, q1"));
  measure<107>("neon_add_independent",
               A9_MICRO_VECTOR_LOOP(16,
                                    "vadd.i8 q0, q0, q4\n\tvadd.i8 q1, q1, q4\n\t"
                                    "vadd.i8 q2, q2, q4\n\tvadd.i8 q3, q3, q4"));
  measure<108>("neon_saturating_add_chain", A9_MICRO_VECTOR_LOOP(64, "vqadd.s8 q0, q0, q1"));
  measure<109>("neon_multiply_add_five", multiply_add_five);
  measure<110>("neon_to_core_chain", A9_MICRO_VECTOR_LOOP(64, "vmov s0, r2\n\tvmov r2, s0"));
}

}  // namespace iog::a9_model::micro
