#include "instruction_counter.hpp"

namespace iog::lab {
namespace {

// Two instructions a turn.
[[gnu::always_inline]] inline void loop(std::uint32_t turns) {
  asm volatile(
      "1: subs %0, %0, #1\n"
      "   bne 1b"
      : "+r"(turns)
      :
      : "cc");
}

}  // namespace

std::uint32_t InstructionCounter::now() {
  const std::uint32_t low = imx6::global_timer.counter_low.read();
  high_ += low < last_low_ ? 1U : 0U;
  last_low_ = low;
  const std::uint64_t ticks = (std::uint64_t{high_} << 32) | low;
  return static_cast<std::uint32_t>((ticks * 5 + 7) / 8);
}

bool InstructionCounter::is_exact() {
  // Five instructions are eight ticks: thirty-two lengths meet every way of rounding.
  constexpr std::uint32_t kLengths = 32;
  std::uint32_t of_one_turn = 0;
  for (std::uint32_t turns = 1; turns <= kLengths; ++turns) {
    const std::uint32_t start = now();
    loop(turns);
    const std::uint32_t count = now() - start;
    of_one_turn = turns == 1 ? count : of_one_turn;
    if (count != of_one_turn + 2 * (turns - 1)) {
      return false;
    }
  }
  const std::uint32_t start = now();
  of_nothing_ = now() - start;
  return true;
}

}  // namespace iog::lab
