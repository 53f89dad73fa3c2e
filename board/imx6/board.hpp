// The SABRE Lite board provides the application with one started object for each interface in hal/.
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
  // Starts all parts in the order of their dependencies. Starting takes about 15 ms, mostly for the
  // reset of the PHY. The constructor services the watchdog, which is already running, once.
  // `address` is used if the chip's fuses contain no address.
  explicit Board(const MacAddress& address);

  GptClock& clock() { return clock_; }
  Stopwatch& stopwatch() { return stopwatch_; }
  Uart& console() { return console_; }
  SerialLink& serial() { return serial_; }
  Watchdog& watchdog() { return watchdog_; }
  EnetPort& ethernet() { return ethernet_; }
  Cores& cores() { return cores_; }

  // Sleeps for at most 1 ms, until a frame arrives, the serial link can send waiting bytes, or the
  // tick ends. The function clears the event flags before it returns, so poll every device between
  // two calls.
  void idle();

  // The interface of hal::SharedCache.
  void keep_cache(bool keep) { l2_cache_.keep(keep); }

  // These functions return the data for the memory check other than the image: the MMU's
  // translation tables, and the guards around the Ethernet controller's rings.
  std::span<const std::byte> translation_tables() const;
  std::array<health::Guard*, 5> ring_guards() const;

  // The interface of hal::Thermometer.
  std::int16_t temperature_dc() { return thermometer_.read_dc(); }

  // Prints the version, the clock rates, the state of the L2 cache, the MAC address, the reason for
  // this boot, and the previous run's last word, if any.
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
