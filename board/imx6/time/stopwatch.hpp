// Uses the Cortex-A9 global timer as a 32-bit stopwatch. The class satisfies hal::Stopwatch.
//
// The timer counts PERIPHCLK, which has half the frequency of the core clock: 396 MHz on the board
// after U-Boot, and 100 MHz in QEMU. The rate of the timer is therefore measured against the
// crystal at start-up.
#pragma once

#include <cstdint>

#include "registers/mpcore.hpp"
#include "time/gpt_clock.hpp"

namespace iog::imx6 {

class Stopwatch {
 public:
  explicit Stopwatch(GlobalTimerRegisters& registers) : registers_(registers) {}

  // Starts the counter and measures its rate. The measurement takes about 2 ms (at most 8 ms) of
  // the running clock.
  void start(GptClock& clock);

  std::uint32_t ticks() const { return registers_.counter_low.read(); }
  std::uint32_t ticks_hz() const { return ticks_hz_; }  // a multiple of 1 MHz

 private:
  std::uint32_t measure_mhz(GptClock& clock) const;

  GlobalTimerRegisters& registers_;
  std::uint32_t ticks_hz_ = 0;
};

}  // namespace iog::imx6
