// EPIT1 by IMX6DQRM, chapter "Enhanced Periodic Interrupt Timer (EPIT)", "Initialization sequence".
#include "time/tick.hpp"

namespace iog::imx6 {
namespace {

using R = EpitRegisters;

// ipg_clk, 66 MHz on the board as in QEMU. Only the length of a nap hangs on it, never a time.
constexpr std::uint32_t kSourceHz = 66'000'000;
constexpr std::uint32_t kLoad = kSourceHz / 1'000'000 * Tick::kPeriodUs - 1;
static_assert(kLoad == 65'999);

constexpr unsigned kMaxResetPolls = 1000;  // as in gpt_clock.cpp

}  // namespace

void Tick::start() {
  registers_.cr.write(0);
  registers_.cr.write(R::kCrSoftReset);
  for (unsigned polls = 0; polls < kMaxResetPolls; ++polls) {
    if ((registers_.cr.read() & R::kCrSoftReset) == 0) {
      break;
    }
  }
  constexpr std::uint32_t kMode = R::kCrPeripheralClock | R::kCrRunInWait | R::kCrLoadAtOnce |
                                  R::kCrReload | R::kCrStartFromLoad;
  registers_.cr.write(kMode);
  registers_.sr.clear(R::kSrCompare);
  registers_.lr.write(kLoad);
  registers_.cmpr.write(0);  // the event is the counter reaching zero
  // The request is enabled together with the counter, not before: a stale flag would be a request.
  registers_.cr.write(kMode | R::kCrInterrupt | R::kCrEnable);
}

}  // namespace iog::imx6
