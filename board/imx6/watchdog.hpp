// The watchdog resets the whole chip when the loop stops. The class satisfies hal::Watchdog.
#pragma once

#include "registers/watchdog.hpp"

namespace iog::imx6 {

class Watchdog {
 public:
  // This time is about a hundred times longer than the slowest pass of the loop, but short for a
  // person.
  static constexpr unsigned kHangMs = 2000;
  // After kHangMs, the watchdog's interrupt reaches core 0 (gic.hpp). Core 0 then has kLastWordMs
  // to store a last word.
  static constexpr unsigned kLastWordMs = 500;
  static constexpr unsigned kTimeoutMs = kHangMs + kLastWordMs;

  explicit Watchdog(WatchdogRegisters& registers) : registers_(registers) {}

  // Starts the watchdog, which then runs until a reset. Further calls have no effect.
  void start();

  // Begins a new period.
  void service();

 private:
  WatchdogRegisters& registers_;
};

}  // namespace iog::imx6
