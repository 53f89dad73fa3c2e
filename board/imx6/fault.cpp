#include "fault.hpp"

#include "boot_record.hpp"
#include "ending.hpp"
#include "helper.hpp"
#include "memory.hpp"
#include "memory/l2_cache.hpp"
#include "peripherals.hpp"
#include "uart.hpp"
#include "watchdog.hpp"

namespace iog {

void board::record_last_word(hal::End end, std::string_view text) {
  imx6::L2Cache cache(imx6::pl310);
  write_last_word(boot_record, end, text, cache);
}

void board::print_last_word(std::string_view text) {
  // If the end came before start_memory() started the watchdog, somebody has to.
  imx6::Watchdog(imx6::wdog1).start();
  imx6::Uart console(imx6::uart2);
  console.write("\nLAST WORD ");
  console.write(text);
  console.write("\n");
  console.flush();
}

void board::wait_for_reset() {
  // A pending line would turn the sleep into a busy wait.
  hear_nobody();
  for (;;) {
    machine::wait_for_interrupt();
  }
}

}  // namespace iog

namespace iog::imx6 {
namespace {

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

}  // namespace

void report_fault(const FaultFrame* frame) {
  const bool hangs = frame->kind == FaultKind::kFastInterrupt;
  end_core({.cause = hangs ? hal::EndCause::kHang : hal::EndCause::kException,
            .detail = hangs ? frame->pc : static_cast<std::uint32_t>(frame->kind)},
           describe(*frame, read_status(frame->kind), memory_map()));
}

}  // namespace iog::imx6
