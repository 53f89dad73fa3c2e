// WDOG1 by IMX6DQRM, chapter "Watchdog Timer (WDOG1-2)".
#include "watchdog.hpp"

#include "hal/watchdog.hpp"

namespace iog::imx6 {

static_assert(hal::Watchdog<Watchdog>);

namespace {

using R = WatchdogRegisters;

// The period is (WT + 1) half seconds.
constexpr std::uint16_t kTimeoutField = Watchdog::kTimeoutMs / 500 - 1;
static_assert((kTimeoutField + 1) * 500 == Watchdog::kTimeoutMs && kTimeoutField <= 0xff);

// SRS and WDA are active low: leaving them high means neither a reset at once nor the WDOG_B pin.
constexpr std::uint16_t kControl =
    static_cast<std::uint16_t>((kTimeoutField << R::kWcrTimeoutShift) | R::kWcrNoExternalAssert |
                               R::kWcrNoSoftwareReset | R::kWcrEnable);

}  // namespace

void Watchdog::start() {
  // The power-down counter runs from reset and would assert WDOG_B after 16 s. PDE can be cleared
  // once.
  registers_.wmcr.write(0);
  // WDE, WDA and SRS can be written once after reset, so a second call must not try (and QEMU
  // checks the wrong register there). If a loader enabled it, the loader's period stays.
  if ((registers_.wcr.read() & R::kWcrEnable) == 0) {
    registers_.wcr.write(kControl);
  }
  service();
}

void Watchdog::service() {
  registers_.wsr.write(R::kWsrFirst);
  registers_.wsr.write(R::kWsrSecond);
}

}  // namespace iog::imx6
