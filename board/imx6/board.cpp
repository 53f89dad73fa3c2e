#include "board.hpp"

#include "clocks.hpp"
#include "ending.hpp"
#include "gic.hpp"
#include "mac_fuses.hpp"
#include "memory.hpp"
#include "peripherals.hpp"
#include "pins.hpp"
#include "text_line.hpp"
#include "version.hpp"

namespace iog::imx6 {
namespace {

// core_start.S.
extern "C" void Helper_Start();  // NOLINT(readability-identifier-naming): as the vectors' handlers

std::uint32_t helper_entry() { return reinterpret_cast<std::uint32_t>(&Helper_Start); }

}  // namespace

Board::Board(const MacAddress& address)
    : mac_address_(address),
      clock_(gpt),
      stopwatch_(global_timer),
      console_(uart2),
      serial_(uart1),
      watchdog_(wdog1),
      tick_(epit1),
      l2_cache_(pl310),
      ethernet_({enet, l2_cache_}, EnetPort::rings_of(enet_memory), l2_cache_, clock_),
      cores_(src, scu, gic_distributor, clock_, all_helpers, helper_entry()),
      thermometer_(analog, ocotp) {
  // It has run since start_memory().
  watchdog_.service();
  reset_status_ = src.srsr.read();
  boot_ = open_boot_record(boot_record, l2_cache_);
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
  // Last, when the stopwatch has run beside clocks that it knows nothing of.
  run_number_ =
      begin_run(boot_record,
                {.noise = boot_noise, .ticks = stopwatch_.ticks(), .mac = mac_address_}, l2_cache_);
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

void Board::end_run(hal::End end, std::string_view words) {
  TextLine line;
  line.text(words_of(end.cause)).text(": ").text(words);
  end_with_last_word(end, line.view());
}

std::uint32_t Board::stack_used_bytes() const { return main_stack_used_bytes(); }
std::uint32_t Board::stack_bytes() const { return main_stack_bytes(); }

void Board::print_banner() {
  TextLine line;
  line.text("iogrid ").text(kVersion).text(" on i.MX6Q, boot ").decimal(boot_.before.starts);
  line.text(": ").text(reason_of(boot_.before.end.cause)).text(", SRSR ").hex(reset_status_);
  line.text(", run ").hex(run_number_).text("\n");
  console_.write(line.view());
  line = {};
  line.text("clock 1 MHz, stopwatch ").decimal(stopwatch_.ticks_hz() / 1'000'000);
  line.text(" MHz, L2 ").text(l2_cache_is_on() ? "on" : "off");
  if (const phy::Identity& phy = ethernet_.phy(); phy.answers()) {
    line.text(", PHY ").hex(phy.id).text(" at ").decimal(phy.address).text("\n");
  } else {
    line.text(", no PHY\n");
  }
  console_.write(line.view());
  line = {};
  line.text("MAC ");
  for (const std::uint8_t octet : mac_address_) {
    line.octet(octet);
  }
  line.text(mac_is_of_fuses_ ? " of the fuses\n" : " of the image\n");
  console_.write(line.view());
  if (boot_.last_word_bytes != 0) {
    console_.write("previous run: LAST WORD ");
    console_.write(boot_.last_word_text());
    console_.write("\n");
  }
}

}  // namespace iog::imx6
