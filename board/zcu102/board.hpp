// The ZCU102 as the application sees it: one object of each seam of hal/, all started.
#pragma once

#include <cstdint>

#include "boot_record.hpp"
#include "cores.hpp"
#include "ethernet/gem.hpp"
#include "hal/end_of_run.hpp"
#include "hal/thermometer.hpp"
#include "memory/uncached_memory.hpp"
#include "serial_link.hpp"
#include "time/clock.hpp"
#include "uart.hpp"
#include "watchdog.hpp"

// What startup.S calls when memory is up; it must not return.
extern "C" int main();

namespace iog::zcu102 {

class Board {
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

  const MacAddress& mac_address() const { return mac_address_; }

  // Sleeps until a frame has arrived, or 1 ms. Poll every device after it and before the next call.
  void idle();

  // Of this run, as hal::RunNumber.
  std::uint32_t run_number() const { return run_number_; }

  // As hal::EndsRuns: by a last word, and a reset by the firmware beneath.
  void end_run(hal::End end, std::string_view words);
  hal::RunBefore run_before() const { return boot_.before; }

  // What the check of memory looks at beside the image: what the MMU walks, and guards around the
  // rings of the Ethernet controller.
  std::span<const std::byte> translation_tables() const;
  std::array<health::Guard*, 5> ring_guards() const { return guards_of(gem_memory); }

  // As hal::Thermometer: the system monitor belongs to the firmware beneath.
  std::int16_t temperature_dc() const { return hal::kTemperatureNotKnown; }

  // The deepest the main stack has been since start, and how deep it may be.
  std::uint32_t stack_used_bytes() const;
  std::uint32_t stack_bytes() const;

  // Version, clock, the MAC address, why this boot, and the previous run's last word if it left
  // one.
  void print_banner();

 private:
  MacAddress mac_address_;
  Clock clock_;
  Stopwatch stopwatch_;
  Uart console_;
  SerialLink serial_;
  Watchdog watchdog_;
  UncachedMemory memory_;
  GemPort ethernet_;
  Cores cores_;
  Boot boot_;
  std::uint32_t run_number_ = 0;
};

}  // namespace iog::zcu102

namespace iog::board {
using zcu102::Board;
using zcu102::Cores;
using zcu102::MacAddress;
}  // namespace iog::board
