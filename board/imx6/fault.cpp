// Runs when everything else has ended, so it trusts little: no driver object, only registers and
// the uncached record, and each step can be reached once.
#include "fault.hpp"

#include "boot_record.hpp"
#include "helper.hpp"
#include "memory.hpp"
#include "peripherals.hpp"
#include "require/require.hpp"
#include "uart.hpp"
#include "watchdog.hpp"

namespace iog::imx6 {
namespace {

constinit bool ending = false;

FaultStatus read_status(FaultKind kind) {
  FaultStatus fault;
  if (kind == FaultKind::kDataAbort) {
    __asm__ volatile("mrc p15, 0, %0, c5, c0, 0" : "=r"(fault.status));
    __asm__ volatile("mrc p15, 0, %0, c6, c0, 0" : "=r"(fault.address));
  }
  if (kind == FaultKind::kPrefetchAbort) {
    __asm__ volatile("mrc p15, 0, %0, c5, c0, 1" : "=r"(fault.status));
    __asm__ volatile("mrc p15, 0, %0, c6, c0, 2" : "=r"(fault.address));
  }
  return fault;
}

[[noreturn]] void wait_for_reset() {
  // A pending line would turn the sleep into a busy wait.
  gic_cpu.ctlr.write(0);
  for (;;) {
    machine::wait_for_interrupt();
  }
}

}  // namespace

void end_with_last_word(hal::End end, std::string_view text) {
  // A fault while reporting a fault says nothing more: the first word is the one that counts.
  if (ending) {
    wait_for_reset();
  }
  ending = true;
  // Recorded before it is printed, because recording cannot block.
  L2Cache cache(pl310);
  write_last_word(boot_record, end, text, cache);
  // If the end came before start_memory() started the watchdog, somebody has to.
  Watchdog(wdog1).start();
  Uart console(uart2);
  console.write("\nLAST WORD ");
  console.write(text);
  console.write("\n");
  console.flush();
  wait_for_reset();
}

// A helper ends alone; core 0 does its work.
void end_core(hal::End end, const TextLine& last_word) {
  if (core_number() != 0) {
    end_helper(hal::CoreState::kFaulted, last_word);
  }
  end_with_last_word(end, last_word.view());
}

void report_fault(const FaultFrame* frame) {
  const bool hangs = frame->kind == FaultKind::kFastInterrupt;
  end_core({.cause = hangs ? hal::EndCause::kHang : hal::EndCause::kException,
            .detail = hangs ? frame->pc : static_cast<std::uint32_t>(frame->kind)},
           describe(*frame, read_status(frame->kind), memory_map()));
}

}  // namespace iog::imx6

// What a broken requirement of the core or of a driver does on the board (src/require/).
void iog::programmer_error(const char* file, int line) {
  imx6::TextLine text;
  text.text("requirement broken at ").text(file).text(":");
  text.decimal(static_cast<std::uint32_t>(line));
  imx6::end_core({.cause = hal::EndCause::kRequirement, .detail = static_cast<std::uint32_t>(line)},
                 text);
}
