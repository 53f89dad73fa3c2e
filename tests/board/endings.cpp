// An image that ends in every way a firmware can end, a different one each boot.
//
// The boot record counts the boots, so one run of the machine sees all of them: each boot prints
// the last word of the boot before it, then ends in its own way, and the watchdog starts the next.
#include <array>
#include <cstdint>

#include "board.hpp"
#include "deep_stack.hpp"
#include "memory.hpp"
#include "require/require.hpp"
#include "text_line.hpp"

namespace {

using iog::imx6::Board;

// In assembly, because the compiler would know better than to do any of this.
void read(std::uintptr_t address) {
  __asm__ volatile("ldr r0, [%0]" ::"r"(address) : "r0", "memory");
}

void write(std::uintptr_t address) { __asm__ volatile("str %0, [%0]" ::"r"(address) : "memory"); }

void call(std::uintptr_t address) {
  __asm__ volatile("blx %0" ::"r"(address) : "r0", "r1", "r2", "r3", "ip", "lr", "memory");
}

// An asynchronous abort as the processor takes one (ARM ARM, B1.9.8), which QEMU has none of: the
// fault status is that of an external one, and Abort mode is entered at its vector.
void abort_asynchronously() {
  __asm__ volatile(
      "movw r0, #0x406\n\t"
      "mcr p15, 0, r0, c5, c0, 0\n\t"
      "mrs r0, cpsr\n\t"
      "mov r1, pc\n\t"
      "cpsid aif, #0x17\n\t"
      "msr spsr_cxsf, r0\n\t"
      "mov lr, r1\n\t"
      "mrc p15, 0, r0, c12, c0, 0\n\t"
      "add pc, r0, #0x10" ::
          : "r0", "r1", "memory");
}

alignas(64) constinit std::array<std::uint32_t, 16> no_code{};

// A constant: read-only and never executed (linker/imx6.ld).
// NOLINTNEXTLINE(readability-identifier-naming): a symbol of the linker script
extern "C" const std::uint32_t image_seal_word __asm__("image_seal");
const auto kImageSeal = reinterpret_cast<std::uintptr_t>(&image_seal_word);

void end_of_boot(std::uint32_t number, Board& board) {
  switch (number) {
    case 1:
      read(0);  // null is not mapped
      return;
    case 2:
      iog::tests::overflow(1);
      return;
    case 3:
      __asm__ volatile("udf #0");
      return;
    case 4:
      __asm__ volatile("svc #0");
      return;
    case 5:
      call(reinterpret_cast<std::uintptr_t>(&no_code));
      return;
    case 6:
      write(reinterpret_cast<std::uintptr_t>(&end_of_boot));
      return;
    case 7:
      write(kImageSeal);
      return;
    case 8:
      write(reinterpret_cast<std::uintptr_t>(&iog::imx6::translation_tables()));
      return;
    case 9:
      call(kImageSeal);
      return;
    case 10:
      board.clock().wait_us(2000);  // the tick is pending by now
      __asm__ volatile("cpsie i");
      return;
    case 11:
      iog::require(iog::tests::never());
      return;
    case 12:
      board.ethernet().commit(60);  // without acquire()
      return;
    case 13:
      abort_asynchronously();
      return;
    case 14:
      board.end_run({.cause = iog::hal::EndCause::kMemory, .detail = 2}, "constants");
      return;
    case 15:
      board.console().write("silence\n");
      for (;;) {
        board.idle();
      }
    case 16:
      board.console().write("silence without interrupts\n");
      __asm__ volatile("cpsid f");
      for (;;) {
        board.idle();
      }
    default:
      board.console().write("all endings seen\n");
      for (;;) {
        board.watchdog().service();
        board.idle();
      }
  }
}

}  // namespace

int main() {
  Board board({0x02, 0, 0, 0, 0, 1});
  board.print_banner();
  const iog::hal::End end = board.run_before().end;
  iog::board::TextLine line;
  line.text("end ").decimal(static_cast<std::uint32_t>(end.cause)).text(" ").decimal(end.detail);
  line.text("\n");
  board.console().write(line.view());
  const bool painted = board.stack_used_bytes() > 0 && board.stack_used_bytes() < 8192;
  board.console().write(painted ? "stack measured\n" : "stack not measured\n");
  end_of_boot(board.run_before().starts, board);
  board.console().write("the end did not come\n");
  for (;;) {
    board.watchdog().service();
    board.idle();
  }
}
