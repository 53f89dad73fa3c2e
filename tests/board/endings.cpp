// An image that ends in every way a firmware can end, a different one each boot.
//
// The boot record counts the boots, so one run of the machine sees all of them: each boot prints
// the last word of the boot before it, then ends in its own way, and a reset starts the next.
#include <array>
#include <cstdint>

#include "board.hpp"
#include "deep_stack.hpp"
#include "own_endings.hpp"
#include "require/require.hpp"
#include "text_line.hpp"

namespace {

using iog::board::Board;
using iog::tests::call;

void write(std::uintptr_t address) { __asm__ volatile("str %0, [%0]" ::"r"(address) : "memory"); }

alignas(64) constinit std::array<std::uint32_t, 16> no_code{};

// A constant: read-only and never executed (linker/<board>.ld).
// NOLINTNEXTLINE(readability-identifier-naming): a symbol of the linker script
extern "C" const std::uint32_t image_seal_word __asm__("image_seal");
const auto kImageSeal = reinterpret_cast<std::uintptr_t>(&image_seal_word);

void end_of_boot(std::uint32_t number, Board& board) {
  switch (number) {
    case 1:
      iog::tests::read(0);  // null is not mapped
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
      write(reinterpret_cast<std::uintptr_t>(board.translation_tables().data()));
      return;
    case 9:
      call(kImageSeal);
      return;
    case 10:
      iog::tests::take_an_interrupt(board);
      return;
    case 11:
      iog::require(iog::tests::never());
      return;
    case 12:
      board.ethernet().commit(60);  // without acquire()
      return;
    case 13:
      board.end_run({.cause = iog::hal::EndCause::kMemory, .detail = 2}, "constants");
      return;
    default:
      iog::tests::end_in_own_way(number - 14, board);
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
