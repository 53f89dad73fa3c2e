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

constexpr std::uint16_t kTimeout = kTimeoutField << R::kWcrTimeoutShift;
constexpr std::uint16_t kTimeoutBits = 0xff << R::kWcrTimeoutShift;

// WICT counts half seconds before the end of the period.
constexpr std::uint16_t kInterrupt = R::kWicrEnable | Watchdog::kLastWordMs / 500;
static_assert(Watchdog::kLastWordMs % 500 == 0 && Watchdog::kLastWordMs > 0);

// SRS and WDA are active low: leaving them high means neither a reset at once nor the WDOG_B pin.
constexpr std::uint16_t kControl =
    kTimeout | R::kWcrNoExternalAssert | R::kWcrNoSoftwareReset | R::kWcrEnable;

}  // namespace

void Watchdog::start() {
  // The power-down counter runs from reset and would assert WDOG_B after 16 s. PDE can be cleared
  // once.
  registers_.wmcr.write(0);
  // WIE and WICT can be written once, too.
  if ((registers_.wicr.read() & R::kWicrEnable) == 0) {
    registers_.wicr.write(kInterrupt);
  }
  // The mode bits and WDE can be written once after reset, and a loader may have done so. WT can be
  // written at any time and counts from the next service on; the other bits stay as they are.
  // A fault starts it again: no write then, because QEMU's model takes a second one for its end.
  const std::uint16_t control = registers_.wcr.read();
  const bool runs = (control & R::kWcrEnable) != 0;
  const std::uint16_t wanted =
      runs ? static_cast<std::uint16_t>((control & ~kTimeoutBits) | kTimeout) : kControl;
  if (control != wanted) {
    registers_.wcr.write(wanted);
  }
  service();
}

void Watchdog::service() {
  registers_.wsr.write(R::kWsrFirst);
  registers_.wsr.write(R::kWsrSecond);
}

}  // namespace iog::imx6
