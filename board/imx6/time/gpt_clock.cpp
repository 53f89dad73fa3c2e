// GPT by IMX6DQRM, chapter "General Purpose Timer (GPT)", section "Initialization".
#include "time/gpt_clock.hpp"

#include "hal/clock.hpp"

namespace iog::imx6 {

static_assert(hal::Clock<GptClock>);

namespace {

using R = GptRegisters;

struct Source {
  std::uint32_t select;
  std::uint32_t hz;
  [[nodiscard]] constexpr std::uint32_t prescaler() const { return hz / 1'000'000 - 1; }
};
constexpr Source kCrystal{R::kCrCrystalBy8, 24'000'000 / 8};
constexpr Source kPeripheral{R::kCrPeripheral, 66'000'000};
static_assert(kCrystal.hz == (kCrystal.prescaler() + 1) * 1'000'000, "a tick is a microsecond");
static_assert(kPeripheral.hz == (kPeripheral.prescaler() + 1) * 1'000'000);

// Software reset takes five module clocks; a thousand reads of a device are at least 50 us.
constexpr unsigned kMaxResetPolls = 1000;
// A counter that stands still (a gated clock) must not hang the start: 100 million reads are
// seconds, more than any wait asked for and enough for the watchdog to notice.
constexpr unsigned kMaxWaitPolls = 100'000'000;

}  // namespace

GptSource gpt_source(const AnalogRegisters& analog) {
  const bool is_first = (analog.digprog.read() & AnalogRegisters::kDigprogRevision) == 0;
  return is_first ? GptSource::kPeripheral : GptSource::kCrystal;
}

void GptClock::start(GptSource source) {
  const Source& its = source == GptSource::kCrystal ? kCrystal : kPeripheral;
  // Off, no interrupts, then the software reset, so that nothing of a loader's timer remains.
  registers_.cr.write(0);
  registers_.ir.write(0);
  registers_.cr.write(R::kCrSoftReset);
  for (unsigned polls = 0; polls < kMaxResetPolls; ++polls) {
    if ((registers_.cr.read() & R::kCrSoftReset) == 0) {
      break;
    }
  }
  registers_.sr.clear(R::kSrAll);
  registers_.pr.write(its.prescaler());
  // The source is chosen while the timer is off, and enabled by a write of its own, as the manual
  // says.
  const std::uint32_t mode = R::kCrFreeRun | its.select | R::kCrRunInWait | R::kCrResetOnEnable;
  registers_.cr.write(mode);
  registers_.cr.write(mode | R::kCrEnable);
  last_low_ = 0;
  wraps_ = 0;
}

std::uint64_t GptClock::now_us() {
  const std::uint32_t low = registers_.cnt.read();
  if (low < last_low_) {
    ++wraps_;
  }
  last_low_ = low;
  return (std::uint64_t{wraps_} << 32) | low;
}

void GptClock::wait_us(std::uint32_t duration_us) {
  const std::uint64_t start_us = now_us();
  for (unsigned polls = 0; polls < kMaxWaitPolls && now_us() - start_us < duration_us; ++polls) {
  }
}

}  // namespace iog::imx6
