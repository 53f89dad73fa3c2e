// The SABRE Lite as the application sees it: one object of each seam of hal/, all started.
#pragma once

#include <cstdint>

#include "board_run.hpp"
#include "cores.hpp"
#include "ethernet/enet.hpp"
#include "memory/l2_cache.hpp"
#include "serial_link.hpp"
#include "thermometer.hpp"
#include "time/gpt_clock.hpp"
#include "time/stopwatch.hpp"
#include "time/tick.hpp"
#include "uart.hpp"
#include "watchdog.hpp"

namespace iog::imx6 {

class Board : public board::BoardRun {
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

  // Sleeps until a frame has arrived, the serial link wants bytes that it was given, or the tick
  // has passed, at most 1 ms. Before it returns, the event flags are cleared; so poll every device
  // after it and before the next call.
  void idle();

  // As hal::SharedCache.
  void keep_cache(bool keep) { l2_cache_.keep(keep); }

  // What the check of memory looks at beside the image: what the MMU walks, and guards around the
  // rings of the Ethernet controller.
  std::span<const std::byte> translation_tables() const;
  std::array<health::Guard*, 5> ring_guards() const;

  // As hal::Thermometer.
  std::int16_t temperature_dc() { return thermometer_.read_dc(); }

  // Version, clock rates, whether the L2 cache is on, the MAC address, why this boot, and the
  // previous run's last word if it left one.
  void print_banner();

 private:
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
  std::uint32_t reset_status_ = 0;
};

}  // namespace iog::imx6

namespace iog::board {
using imx6::Board;
using imx6::Cores;
}  // namespace iog::board
