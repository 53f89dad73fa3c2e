// Global timer by ARM DDI 0407, chapter 4.
#include "time/stopwatch.hpp"

#include "hal/clock.hpp"

namespace iog::imx6 {

static_assert(hal::Stopwatch<Stopwatch>);

namespace {

constexpr std::uint32_t kMeasureUs = 1000;
// Two readings that agree are believed. An emulator that the host puts aside between two reads
// measures nonsense, and eight tries are enough to find a quiet pair.
constexpr unsigned kMaxMeasurements = 8;

}  // namespace

void Stopwatch::start(GptClock& clock) {
  // No comparator, no interrupt, prescaler 1: count every PERIPHCLK.
  registers_.control.write(GlobalTimerRegisters::kControlEnable);
  std::uint32_t mhz = measure_mhz(clock);
  for (unsigned tries = 1; tries < kMaxMeasurements; ++tries) {
    const std::uint32_t again = measure_mhz(clock);
    if (again == mhz) {
      break;
    }
    mhz = again;
  }
  ticks_hz_ = mhz * 1'000'000;
}

// Ticks in a millisecond, rounded to whole megahertz: every PLL setting of this chip gives one, and
// the clock's own grain of 1 us in 1000 stays below the rounding for any rate up to 500 MHz.
std::uint32_t Stopwatch::measure_mhz(GptClock& clock) const {
  clock.wait_us(1);  // begin just after an edge of the microsecond
  const std::uint64_t start_us = clock.now_us();
  const std::uint32_t start_ticks = ticks();
  clock.wait_us(kMeasureUs);
  const std::uint32_t elapsed_ticks = ticks() - start_ticks;
  const auto elapsed_us = static_cast<std::uint32_t>(clock.now_us() - start_us);
  return elapsed_us == 0 ? 0 : (elapsed_ticks + elapsed_us / 2) / elapsed_us;
}

}  // namespace iog::imx6
