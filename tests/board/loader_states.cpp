// What the start-up made of the state that a loader left: printed, for loader_states_test to judge.
#include <array>
#include <cstdint>

#include "board.hpp"
#include "peripherals.hpp"
#include "text_line.hpp"

namespace {

using iog::board::TextLine;
using iog::imx6::Board;

constexpr unsigned kNaps = 1000;
constexpr unsigned kWords = 30;
constexpr std::uint64_t kWordUs = 100'000;

// Zeroed memory as large as a firmware with classes has, because writing it takes time.
constinit std::array<std::uint8_t, 36u << 20> as_much_as_a_firmware{};

void print(Board& board, std::string_view name, std::uint32_t value) {
  TextLine line;
  line.text(name).text(" ").hex(value).text("\n");
  board.console().write(line.view());
}

// The loader has filled it with noise. A prime is the step, so that in the end all bytes of a line
// are asked for; to ask each takes longer than the watchdog waits.
std::uint32_t not_zeroed() {
  constexpr std::size_t kStep = 997;
  std::uint32_t found = iog::machine::load(as_much_as_a_firmware.back());
  for (std::size_t at = 0; at < as_much_as_a_firmware.size(); at += kStep) {
    found += iog::machine::load(as_much_as_a_firmware[at]) != 0 ? 1U : 0U;
  }
  return found;
}

std::uint32_t system_control() {
  std::uint32_t sctlr = 0;
  __asm__ volatile("mrc p15, 0, %0, c1, c0, 0" : "=r"(sctlr));
  return sctlr;
}

std::uint32_t program_status() {
  std::uint32_t cpsr = 0;
  __asm__ volatile("mrs %0, cpsr" : "=r"(cpsr));
  return cpsr;
}

}  // namespace

int main() {
  static Board board({0x02, 0, 0, 0, 0, 1});
  board.print_banner();
  print(board, "sctlr", system_control());
  print(board, "cpsr", program_status());
  // The test has linked the PL310 into RAM, where nothing answers and everything is kept.
  print(board, "l2 cleaned", iog::imx6::pl310.clean_invalidate_by_way.read());
  print(board, "l2 control", iog::imx6::pl310.control.read());
  print(board, "not zeroed", not_zeroed());
  // What nobody writes would be a constant.
  iog::machine::store(as_much_as_a_firmware.back(), std::uint8_t{1});
  const std::uint64_t begin_us = board.clock().now_us();
  for (unsigned nap = 0; nap < kNaps; ++nap) {
    board.idle();
    board.watchdog().service();
  }
  TextLine line;
  line.decimal(kNaps).text(" naps of ");
  line.decimal(static_cast<std::uint32_t>((board.clock().now_us() - begin_us) / kNaps))
      .text(" us\n");
  board.console().write(line.view());
  // The watchdog ends this, and how many words there are says when. By the clock: its interrupt
  // ends every nap at once where the core does not take it.
  for (unsigned word = 0; word < kWords; ++word) {
    const std::uint64_t said_us = board.clock().now_us();
    while (board.clock().now_us() - said_us < kWordUs) {
      board.idle();
    }
    board.console().write("unserved\n");
  }
  board.console().write("no watchdog\n");
  for (;;) {
    board.idle();
  }
}
