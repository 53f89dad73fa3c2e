// The firmware: the board, started, and the loop that the application will live in.
#include "board.hpp"

namespace {

// Locally administered. One car, one box: give each box of a network its own.
constexpr iog::imx6::MacAddress kMacAddress = {0x02, 0x69, 0x6f, 0x67, 0x00, 0x01};

}  // namespace

int main() {
  iog::imx6::Board board(kMacAddress);
  board.print_banner();
  for (;;) {
    board.watchdog().service();
    while (!board.ethernet().receive().empty()) {
      board.ethernet().release();
    }
    board.ethernet().pump();
    board.idle();
  }
}
