// The watchdog of the full-power domain detects that the loop has stopped. The class satisfies
// hal::Watchdog.
//
// When the watchdog expires, it signals the platform management unit. This unit resets the chip
// only if the unit's firmware is configured to do so (UG1085, "System Watchdog Timers"). QEMU has
// no such unit.
#pragma once

#include "registers/watchdog.hpp"

namespace iog::zcu102 {

class Watchdog {
 public:
  static constexpr std::uint32_t kTimeoutMs = 2500;       // as on the i.MX6
  static constexpr std::uint32_t kClockHz = 100'000'000;  // LSBUS, as set by the board's FSBL

  explicit Watchdog(WatchdogRegisters& registers) : registers_(registers) {}

  void start();
  void service() { registers_.restart.write(WatchdogRegisters::kRestartKey); }

 private:
  WatchdogRegisters& registers_;
};

}  // namespace iog::zcu102
