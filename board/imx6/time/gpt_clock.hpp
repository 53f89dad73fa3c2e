// Microseconds since start, from the General Purpose Timer. Satisfies hal::Clock.
//
// CLKSRC 5 is the 24 MHz crystal divided by eight, 3 MHz, on the i.MX6Q from revision 1.1 on and in
// QEMU; the prescaler makes it 1 MHz. Revision 1.0, which QEMU reports, has no such source. There
// the driver uses CLKSRC 1, ipg_clk: 66 MHz from the same crystal by PLL2, as the loader has left
// it (as Linux does, clk-imx6q.c). CLKSRC 7 is 24 MHz in QEMU only, and the chip's own 24 MHz path
// (EN_24M) exists only on the other i.MX6.
#pragma once

#include <cstdint>

#include "registers/analog.hpp"
#include "registers/gpt.hpp"

namespace iog::imx6 {

enum class GptSource : std::uint8_t { kCrystal, kPeripheral };

// The source of this chip revision.
GptSource gpt_source(const AnalogRegisters& analog);

class GptClock {
 public:
  explicit GptClock(GptRegisters& registers) : registers_(registers) {}

  void start(GptSource source = GptSource::kCrystal);

  // Must be called at least once in 71 minutes, the period of the 32-bit counter: the loop does it
  // every millisecond.
  std::uint64_t now_us();

  // Busy-waits. For the start-up sequences that a data sheet times, never in the loop.
  void wait_us(std::uint32_t duration_us);

 private:
  GptRegisters& registers_;
  std::uint32_t last_low_ = 0;
  std::uint32_t wraps_ = 0;
};

}  // namespace iog::imx6
