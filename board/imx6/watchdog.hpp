// The watchdog that resets the whole chip when the loop stops. Satisfies hal::Watchdog.
#pragma once

#include "registers/watchdog.hpp"

namespace iog::imx6 {

class Watchdog {
 public:
  // About a hundred times longer than the slowest pass of the loop, yet short for a person.
  static constexpr unsigned kHangMs = 2000;
  // After the time above, its interrupt reaches core 0 (gic.hpp), which has this time to store a
  // last word.
  static constexpr unsigned kLastWordMs = 500;
  static constexpr unsigned kTimeoutMs = kHangMs + kLastWordMs;

  explicit Watchdog(WatchdogRegisters& registers) : registers_(registers) {}

  // Starts the watchdog. It then runs until a reset. Further calls have no effect.
  void start();

  // Begins a new period.
  void service();

 private:
  WatchdogRegisters& registers_;
};

}  // namespace iog::imx6
