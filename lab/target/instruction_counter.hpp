// Instructions executed, read from the A9 global timer of a QEMU that counts instructions.
//
// Under `-icount shift=4` an instruction lasts 16 ns of the guest's time and the timer counts 10
// ns, so the timer stands at floor(k * 16 / 10) after k instructions. Ticks are denser than
// instructions and k = ceil(ticks * 10 / 16), exactly. An instruction whose condition fails counts,
// too.
#pragma once

#include <cstdint>

#include "peripherals.hpp"

namespace iog::lab {

class InstructionCounter {
 public:
  static constexpr std::uint32_t kInstructionsPerSecond = 62'500'000;  // of the guest's time

  void start() { imx6::global_timer.control.write(imx6::GlobalTimerRegisters::kControlEnable); }

  // Instructions since start(), modulo 2^32. At least once in 2^32 ticks, which are 2.7e9
  // instructions, so that the upper half of the count can be kept here.
  [[gnu::noinline]] std::uint32_t now();

  // What a pair of now() finds between its two readings where there is nothing between them.
  [[nodiscard]] std::uint32_t of_nothing() const { return of_nothing_; }

  // Counts loops of known length and says whether every count was exact; it is not under another
  // emulator, or another icount. Sets of_nothing().
  [[nodiscard]] bool is_exact();

 private:
  std::uint32_t last_low_ = 0;
  std::uint32_t high_ = 0;
  std::uint32_t of_nothing_ = 0;
};

}  // namespace iog::lab
