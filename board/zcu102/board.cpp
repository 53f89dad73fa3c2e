#include "board.hpp"

#include "ending.hpp"
#include "gic.hpp"
#include "memory.hpp"
#include "peripherals.hpp"
#include "text_line.hpp"
#include "version.hpp"

namespace iog::zcu102 {

Board::Board(const MacAddress& address)
    : mac_address_(address),
      console_(uart0),
      serial_(uart1),
      watchdog_(swdt),
      ethernet_({gem3, crl_apb}, GemPort::rings_of(gem_memory), memory_, clock_),
      cores_(gic_distributor, clock_, all_helpers) {
  watchdog_.start();
  boot_ = open_boot_record(boot_record, memory_);
  console_.start();
  serial_.start();
  ethernet_.start(mac_address_);
  start_gic(gic_distributor, gic_cpu);
  run_number_ =
      begin_run(boot_record,
                {.noise = boot_noise, .ticks = stopwatch_.ticks(), .mac = mac_address_}, memory_);
}

void Board::idle() {
  machine::alarm_in(machine::counter_hz() / 1000);
  machine::wait_for_interrupt();
  machine::alarm_off();
  ethernet_.clear_event();
  // The flags are down before anything is polled; a device takes a store when it likes.
  machine::barrier();
}

void Board::end_run(hal::End end, std::string_view words) {
  TextLine line;
  line.text(words_of(end.cause)).text(": ").text(words);
  end_with_last_word(end, line.view());
}

std::span<const std::byte> Board::translation_tables() const {
  return std::as_bytes(std::span(&zcu102::translation_tables(), 1));
}

std::uint32_t Board::stack_used_bytes() const { return main_stack_used_bytes(); }
std::uint32_t Board::stack_bytes() const { return main_stack_bytes(); }

void Board::print_banner() {
  TextLine line;
  line.text("iogrid ").text(kVersion).text(" on Zynq UltraScale+, boot ");
  line.decimal(boot_.before.starts).text(": ").text(reason_of(boot_.before.end.cause));
  line.text(", run ").hex(run_number_).text("\n");
  console_.write(line.view());
  line = {};
  line.text("counter ").decimal(stopwatch_.ticks_hz() / 1000).text(" kHz, MAC ");
  for (const std::uint8_t octet : mac_address_) {
    line.octet(octet);
  }
  line.text(" of the image");
  if (const phy::Identity& phy = ethernet_.phy(); phy.answers()) {
    line.text(", PHY ").hex(phy.id).text(" at ").decimal(phy.address).text("\n");
  } else {
    line.text(", no PHY\n");
  }
  console_.write(line.view());
  if (boot_.last_word_bytes != 0) {
    console_.write("previous run: LAST WORD ");
    console_.write(boot_.last_word_text());
    console_.write("\n");
  }
}

}  // namespace iog::zcu102
