// The ZCU102 as the application sees it: one object of each seam of hal/, all started.
#pragma once

#include <cstdint>

#include "board_run.hpp"
#include "cores.hpp"
#include "ethernet/gem.hpp"
#include "hal/thermometer.hpp"
#include "memory/uncached_memory.hpp"
#include "serial_link.hpp"
#include "time/clock.hpp"
#include "uart.hpp"
#include "watchdog.hpp"

namespace iog::zcu102 {

class Board : public board::BoardRun {
 public:
  // Starts everything, in the order in which the parts need each other.
  explicit Board(const MacAddress& address);

  Clock& clock() { return clock_; }
  Stopwatch& stopwatch() { return stopwatch_; }
  Uart& console() { return console_; }
  SerialLink& serial() { return serial_; }
  Watchdog& watchdog() { return watchdog_; }
  GemPort& ethernet() { return ethernet_; }
  Cores& cores() { return cores_; }

  // Sleeps until a frame has arrived, or 1 ms. Poll every device after it and before the next call.
  void idle();

  // What the check of memory looks at beside the image: what the MMU walks, and guards around the
  // rings of the Ethernet controller.
  std::span<const std::byte> translation_tables() const;
  std::array<health::Guard*, 5> ring_guards() const { return guards_of(gem_memory); }

  // As hal::Thermometer: the system monitor belongs to the firmware beneath.
  std::int16_t temperature_dc() const { return hal::kTemperatureNotKnown; }

  // Version, clock, the MAC address, why this boot, and the previous run's last word if it left
  // one.
  void print_banner();

 private:
  Clock clock_;
  Stopwatch stopwatch_;
  Uart console_;
  SerialLink serial_;
  Watchdog watchdog_;
  UncachedMemory memory_;
  GemPort ethernet_;
  Cores cores_;
};

}  // namespace iog::zcu102

namespace iog::board {
using zcu102::Board;
using zcu102::Cores;
}  // namespace iog::board
