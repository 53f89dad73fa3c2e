// Branches that any predictor foresees, that none does, and that tell what a predictor has.

#include "micro.hpp"

namespace iog::a9_model::micro {
namespace {

constexpr std::uint32_t kTurns = 20'000;

std::uint32_t count_down() {
  std::uint32_t turns = kTurns;
  __asm__ volatile("1:\n\tsubs %0, %0, #1\n\tbne 1b" : "+r"(turns) : : "cc");
  return kTurns;
}

// Taken by a bit that a linear congruential generator makes: unforeseeable, half of them taken.
std::uint32_t flip_coins() {
  std::uint32_t turns = kTurns;
  std::uint32_t random = 1;
  __asm__ volatile(
      "1:\n\tmla %1, %1, %2, %3\n\ttst %1, #0x80000000\n\tbeq 2f\n\tadd r2, r2, #1\n"
      "2:\n\tsubs %0, %0, #1\n\tbne 1b"
      : "+r"(turns), "+r"(random)
      : "r"(1664525u), "r"(1013904223u)
      : "r2", "cc");
  return kTurns;
}

std::uint32_t alternate() {
  std::uint32_t turns = kTurns;
  __asm__ volatile(
      "1:\n\ttst %0, #1\n\tbeq 2f\n\tadd r2, r2, #1\n"
      "2:\n\tsubs %0, %0, #1\n\tbne 1b"
      : "+r"(turns)
      :
      : "r2", "cc");
  return kTurns;
}

// Goes down by kDepth calls and comes back, over and over; the return stack holds eight.
template <unsigned kDepth>
[[gnu::noinline]] void descend() {
  if constexpr (kDepth > 1) {
    descend<kDepth - 1>();
  }
  __asm__ volatile("" ::: "memory");  // no tail call
}

template <unsigned kDepth>
std::uint32_t call() {
  for (std::uint32_t turn = 0; turn < kTurns / kDepth; ++turn) {
    descend<kDepth>();
  }
  return kTurns / kDepth;
}

// A jump through a register that has two targets in turn.
std::uint32_t jump_in_turn() {
  std::uint32_t turns = kTurns;
  __asm__ volatile(
      "1:\n\tand r2, %0, #1\n\tadr r3, 2f\n\tadd r3, r3, r2, lsl #2\n\tmov r4, #0\n\tbx r3\n"
      "2:\n\tnop\n\tnop\n\tsubs %0, %0, #1\n\tbne 1b"
      : "+r"(turns)
      :
      : "r2", "r3", "r4", "cc");
  return kTurns;
}

}  // namespace

void measure_branches() {
  measure<80>("loop", count_down);
  measure<81>("coin", flip_coins);
  measure<82>("alternating", alternate);
  measure<83>("calls_8_deep", call<8>);
  measure<84>("calls_12_deep", call<12>);
  measure<85>("two_targets", jump_in_turn);
}

}  // namespace iog::a9_model::micro
