// The watchdog that resets the whole chip when the loop stops. Satisfies hal::Watchdog.
#pragma once

#include "registers/watchdog.hpp"

namespace iog::imx6 {

class Watchdog {
 public:
  // Some hundred times longer than the slowest pass of the loop, and short for a person.
  static constexpr unsigned kHangMs = 2000;
  // Then its interrupt tells core 0 (gic.hpp), which has this long to leave a last word.
  static constexpr unsigned kLastWordMs = 500;
  static constexpr unsigned kTimeoutMs = kHangMs + kLastWordMs;

  explicit Watchdog(WatchdogRegisters& registers) : registers_(registers) {}

  // Starts counting; from here on only service() or a reset stops it. Calling it again does
  // nothing.
  void start();

  // Begins a new period.
  void service();

 private:
  WatchdogRegisters& registers_;
};

}  // namespace iog::imx6
