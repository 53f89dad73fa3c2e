// The watchdog of the full-power domain, which detects that the loop has stopped. Satisfies
// hal::Watchdog.
//
// When it expires, it signals the platform management unit, which resets the chip only if its
// firmware is configured to do so (UG1085, "System Watchdog Timers"). QEMU has none.
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
