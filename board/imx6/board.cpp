#include "board.hpp"

#include "clocks.hpp"
#include "gic.hpp"
#include "mac_fuses.hpp"
#include "memory.hpp"
#include "peripherals.hpp"
#include "pins.hpp"

namespace iog::imx6 {
namespace {

// core_start.S.
extern "C" void Helper_Start();  // NOLINT(readability-identifier-naming): as the vectors' handlers

std::uint32_t helper_entry() { return reinterpret_cast<std::uint32_t>(&Helper_Start); }

}  // namespace

Board::Board(const MacAddress& address)
    : BoardRun(address),
      clock_(gpt),
      stopwatch_(global_timer),
      console_(uart2),
      serial_(uart1),
      watchdog_(wdog1),
      tick_(epit1),
      l2_cache_(pl310),
      ethernet_(Enet(enet), EnetPort::rings_of(enet_memory), l2_cache_, clock_),
      cores_(src, scu, gic_distributor, clock_, all_helpers, helper_entry()),
      thermometer_(analog, ocotp) {
  // It has run since start_memory().
  watchdog_.service();
  reset_status_ = src.srsr.read();
  open_record(l2_cache_);
  start_clocks(ccm);
  start_console_pins(iomuxc);
  console_.start();
  start_serial_pins(iomuxc);
  serial_.start();
  clock_.start(gpt_source(analog));
  stopwatch_.start(clock_);
  start_ethernet_pins(iomuxc, gpio3, gpio6, clock_);
  if (const auto fused = mac_of_fuses(ocotp)) {
    mac_address_ = *fused;
    mac_is_of_fuses_ = true;
  }
  ethernet_.start(mac_address_);
  thermometer_.start();
  tick_.start();
  start_gic(gic_distributor, gic_cpu);
  // From here on the watchdog's interrupt finds a loop that hangs.
  __asm__ volatile("cpsie f" ::: "memory");
  number_run(stopwatch_.ticks(), l2_cache_);
}

std::span<const std::byte> Board::translation_tables() const {
  return std::as_bytes(std::span(&imx6::translation_tables(), 1));
}

std::array<health::Guard*, 5> Board::ring_guards() const { return guards_of(enet_memory); }

void Board::idle() {
  machine::wait_for_interrupt();
  tick_.clear();
  ethernet_.clear_event();
  // The flags are down before anything is polled; a device takes a store when it likes.
  machine::barrier();
}

void Board::print_banner() {
  TextLine line = begin_banner("i.MX6Q");
  line.text(", SRSR ").hex(reset_status_).text(", run ").hex(run_number()).text("\n");
  console_.write(line.view());
  line = {};
  line.text("clock 1 MHz, stopwatch ").decimal(stopwatch_.ticks_hz() / 1'000'000);
  line.text(" MHz, L2 ").text(l2_cache_is_on() ? "on" : "off");
  add_phy(line, ethernet_.phy());
  console_.write(line.view());
  line = {};
  add_mac(line);
  line.text(mac_is_of_fuses_ ? " of the fuses\n" : " of the image\n");
  console_.write(line.view());
  print_last_word_before(console_);
}

}  // namespace iog::imx6
