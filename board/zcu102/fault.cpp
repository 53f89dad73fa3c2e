#include "fault.hpp"

#include "boot_record.hpp"
#include "ending.hpp"
#include "helper.hpp"
#include "memory.hpp"
#include "memory/uncached_memory.hpp"
#include "peripherals.hpp"
#include "psci.hpp"
#include "uart.hpp"
#include "watchdog.hpp"

namespace iog {

void board::record_last_word(hal::End end, std::string_view text) {
  zcu102::UncachedMemory memory;
  write_last_word(boot_record, end, text, memory);
}

void board::print_last_word(std::string_view text) {
  zcu102::Uart console(zcu102::uart0);
  console.write("\nLAST WORD ");
  console.write(text);
  console.write("\n");
  console.flush();
}

// The firmware beneath resets the chip; should it not, the watchdog does.
void board::wait_for_reset() {
  zcu102::Watchdog(zcu102::swdt).start();
  hear_nobody();
  machine::call_psci(zcu102::psci::kSystemReset);
  for (;;) {
    machine::wait_for_interrupt();
  }
}

}  // namespace iog

namespace iog::zcu102 {

void report_fault(const FaultFrame* frame) {
  end_core({.cause = hal::EndCause::kException, .detail = static_cast<std::uint32_t>(frame->kind)},
           describe(*frame, in_stack_guard(frame->far)));
}

}  // namespace iog::zcu102
