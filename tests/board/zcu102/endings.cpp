// An image that ends in every way a firmware of the ZCU102 can end, a different one each boot, as
// tests/board/endings.cpp does on the i.MX6. PSCI starts the next boot.
#include <array>
#include <cstdint>

#include "board.hpp"
#include "memory.hpp"
#include "require/require.hpp"
#include "tests/board/deep_stack.hpp"
#include "text_line.hpp"

namespace {

using iog::board::Board;

// In assembly, because the compiler would know better than to do any of this.
void read(std::uintptr_t address) {
  __asm__ volatile("ldr x0, [%0]" ::"r"(address) : "x0", "memory");
}

void write(std::uintptr_t address) { __asm__ volatile("str %0, [%0]" ::"r"(address) : "memory"); }

void call(std::uintptr_t address) {
  __asm__ volatile("blr %0" ::"r"(address) : "x0", "x1", "x2", "x3", "x30", "memory");
}

alignas(64) constinit std::array<std::uint32_t, 16> no_code{};

// A constant: read-only and never executed (linker/zcu102.ld).
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
      write(reinterpret_cast<std::uintptr_t>(&iog::zcu102::translation_tables()));
      return;
    case 9:
      call(kImageSeal);
      return;
    case 10:
      iog::machine::alarm_in(1);
      __asm__ volatile("msr daifclr, #2\n\tisb");
      return;
    case 11:
      call(reinterpret_cast<std::uintptr_t>(&end_of_boot) + 1);  // no place of an instruction
      return;
    case 12:
      iog::require(iog::tests::never());
      return;
    case 13:
      board.ethernet().commit(60);  // without acquire()
      return;
    case 14:
      read(std::uintptr_t{1} << 40);  // behind all that is mapped
      return;
    case 15:
      board.end_run({.cause = iog::hal::EndCause::kMemory, .detail = 2}, "constants");
      return;
    default:
      board.console().write("all endings seen\n");
      for (;;) {
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
    board.idle();
  }
}
