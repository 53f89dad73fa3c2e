// SWDT by UG1085, section "System Watchdog Timers, Programming Model".
#include "watchdog.hpp"

#include "hal/watchdog.hpp"

namespace iog::zcu102 {

static_assert(hal::Watchdog<Watchdog>);

namespace {

using R = WatchdogRegisters;

// The counter begins at the field, with twelve ones below it.
constexpr std::uint32_t kCounts =
    std::uint64_t{Watchdog::kClockHz} / 4096 * Watchdog::kTimeoutMs / 1000;
constexpr std::uint32_t kField = (kCounts + 0xfff) >> 12;
static_assert(kField == 15 && kField <= 0xfff);

}  // namespace

void Watchdog::start() {
  // Off while its period changes.
  registers_.mode.write(R::kModeKey | R::kModeReset16Clocks);
  registers_.control.write(R::kControlKey | kField << R::kControlCounterShift | R::kControlBy4096);
  registers_.mode.write(R::kModeKey | R::kModeReset16Clocks | R::kModeReset | R::kModeEnable);
  service();
}

}  // namespace iog::zcu102
