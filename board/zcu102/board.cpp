#include "board.hpp"

#include "gic.hpp"
#include "memory.hpp"
#include "peripherals.hpp"

namespace iog::zcu102 {

Board::Board(const MacAddress& address)
    : BoardRun(address),
      console_(uart0),
      serial_(uart1),
      watchdog_(swdt),
      ethernet_({gem3, crl_apb}, GemPort::rings_of(gem_memory), memory_, clock_),
      cores_(gic_distributor, clock_, all_helpers) {
  watchdog_.start();
  open_record(memory_);
  console_.start();
  serial_.start();
  ethernet_.start(mac_address_);
  start_gic(gic_distributor, gic_cpu);
  number_run(stopwatch_.ticks(), memory_);
}

void Board::idle() {
  machine::alarm_in(machine::counter_hz() / 1000);
  machine::wait_for_interrupt();
  machine::alarm_off();
  ethernet_.clear_event();
  // The flags are down before anything is polled; a device takes a store when it likes.
  machine::barrier();
}

std::span<const std::byte> Board::translation_tables() const {
  return std::as_bytes(std::span(&zcu102::translation_tables(), 1));
}

void Board::print_banner() {
  TextLine line = begin_banner("Zynq UltraScale+");
  line.text(", run ").hex(run_number()).text("\n");
  console_.write(line.view());
  line = {};
  line.text("counter ").decimal(stopwatch_.ticks_hz() / 1000).text(" kHz, ");
  add_mac(line);
  line.text(" of the image");
  add_phy(line, ethernet_.phy());
  console_.write(line.view());
  print_last_word_before(console_);
}

}  // namespace iog::zcu102
