// Counts microseconds since start-up with the General Purpose Timer. The class satisfies
// hal::Clock.
//
// In QEMU and on the i.MX6Q since revision 1.1, CLKSRC 5 is the 24 MHz crystal divided by eight,
// that is, 3 MHz. The prescaler divides this clock to 1 MHz. Revision 1.0, which QEMU reports, has
// no such source. On revision 1.0, the driver uses CLKSRC 1 (ipg_clk), which has 66 MHz. The boot
// loader derives this clock from the same crystal through PLL2 (Linux does the same, clk-imx6q.c).
// CLKSRC 7 is 24 MHz only in QEMU. The 24 MHz path in the chip (EN_24M) exists only on other i.MX6
// variants.
#pragma once

#include <cstdint>

#include "registers/analog.hpp"
#include "registers/gpt.hpp"

namespace iog::imx6 {

enum class GptSource : std::uint8_t { kCrystal, kPeripheral };

// Returns the clock source for this chip revision.
GptSource gpt_source(const AnalogRegisters& analog);

class GptClock {
 public:
  explicit GptClock(GptRegisters& registers) : registers_(registers) {}

  void start(GptSource source = GptSource::kCrystal);

  // Call this function at least once in 71 minutes, the period of the 32-bit counter. The loop
  // calls it every millisecond.
  std::uint64_t now_us();

  // Busy-waits. Use this function only for start-up sequences with times from a data sheet, and
  // never in the loop.
  void wait_us(std::uint32_t duration_us);

 private:
  GptRegisters& registers_;
  std::uint32_t last_low_ = 0;
  std::uint32_t wraps_ = 0;
};

}  // namespace iog::imx6
