// The ZCU102 board provides the application with one started object for each interface in hal/.
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
  // Starts all parts in the order of their dependencies.
  explicit Board(const MacAddress& address);

  Clock& clock() { return clock_; }
  Stopwatch& stopwatch() { return stopwatch_; }
  Uart& console() { return console_; }
  SerialLink& serial() { return serial_; }
  Watchdog& watchdog() { return watchdog_; }
  GemPort& ethernet() { return ethernet_; }
  Cores& cores() { return cores_; }

  // Sleeps until a frame arrives, but for at most 1 ms. Poll every device between two calls.
  void idle();

  // These functions return the data for the memory check other than the image: the MMU's
  // translation tables, and the guards around the Ethernet controller's rings.
  std::span<const std::byte> translation_tables() const;
  std::array<health::Guard*, 5> ring_guards() const { return guards_of(gem_memory); }

  // The interface of hal::Thermometer. The system monitor belongs to the platform firmware.
  std::int16_t temperature_dc() const { return hal::kTemperatureNotKnown; }

  // Prints the version, the clock, the MAC address, the reason for this boot, and the previous
  // run's last word, if any.
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
