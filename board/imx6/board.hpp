// The SABRE Lite as the application sees it: one object of each seam of hal/, all started.
#pragma once

#include <cstdint>

#include "boot_record.hpp"
#include "cores.hpp"
#include "ethernet/enet.hpp"
#include "hal/end_of_run.hpp"
#include "memory/l2_cache.hpp"
#include "serial_link.hpp"
#include "thermometer.hpp"
#include "time/gpt_clock.hpp"
#include "time/stopwatch.hpp"
#include "time/tick.hpp"
#include "uart.hpp"
#include "watchdog.hpp"

// What startup.S calls when memory is up. In freestanding C++ main() is a function like any other,
// so it needs a declaration and the name that the assembler knows. It must not return.
extern "C" int main();

namespace iog::imx6 {

class Board {
 public:
  // Starts everything, in the order in which the parts need each other. Takes some 15 ms, most of
  // it the reset of the PHY. The watchdog, which the start-up has started, is serviced once. The
  // address is for a chip whose fuses hold none.
  explicit Board(const MacAddress& address);

  GptClock& clock() { return clock_; }
  Stopwatch& stopwatch() { return stopwatch_; }
  Uart& console() { return console_; }
  SerialLink& serial() { return serial_; }
  Watchdog& watchdog() { return watchdog_; }
  EnetPort& ethernet() { return ethernet_; }
  Cores& cores() { return cores_; }

  const MacAddress& mac_address() const { return mac_address_; }

  // What the boot record said, and SRC_SRSR as this boot found it (QEMU always says 1, power-on).
  const Boot& boot() const { return boot_; }
  std::uint32_t reset_status() const { return reset_status_; }

  // Sleeps until a frame has arrived, the serial link wants bytes that it was given, or the tick
  // has passed, at most 1 ms. Before it returns, the event flags are cleared; so poll every device
  // after it and before the next call.
  void idle();

  // Of this run, as hal::RunNumber.
  std::uint32_t run_number() const { return run_number_; }

  // As hal::EndsRuns: by a last word, and the watchdog's reset.
  void end_run(hal::End end, std::string_view words);
  hal::RunBefore run_before() const { return boot_.before; }

  // As hal::SharedCache.
  void keep_cache(bool keep) { l2_cache_.keep(keep); }

  // What the check of memory looks at beside the image: what the MMU walks, and guards around the
  // rings of the Ethernet controller.
  std::span<const std::byte> translation_tables() const;
  std::array<health::Guard*, 5> ring_guards() const;

  // As hal::Thermometer.
  std::int16_t temperature_dc() { return thermometer_.read_dc(); }

  // The deepest the main stack has been since start, and how deep it may be.
  std::uint32_t stack_used_bytes() const;
  std::uint32_t stack_bytes() const;

  // Version, clock rates, whether the L2 cache is on, the MAC address, why this boot, and the
  // previous run's last word if it left one.
  void print_banner();

 private:
  MacAddress mac_address_;
  bool mac_is_of_fuses_ = false;
  GptClock clock_;
  Stopwatch stopwatch_;
  Uart console_;
  SerialLink serial_;
  Watchdog watchdog_;
  Tick tick_;
  L2Cache l2_cache_;
  EnetPort ethernet_;
  Cores cores_;
  Thermometer thermometer_;
  Boot boot_;
  std::uint32_t reset_status_ = 0;
  std::uint32_t run_number_ = 0;
};

}  // namespace iog::imx6

namespace iog::board {
using imx6::Board;
using imx6::Cores;
using imx6::MacAddress;
}  // namespace iog::board
